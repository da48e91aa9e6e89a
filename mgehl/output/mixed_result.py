"""The numbers of a rough contact: how film and solid share load and area, and how thick the film is."""

from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from mgehl.discretization.status import CAVITATED, CONTACT, LUBRICATED, is_fluid
from mgehl.output.fields import Fields
from mgehl.output.gap_error import GapError
from mgehl.solver.gaps import gaps_of, within_hertz

BESIDE = np.ones((3, 3))
"""Nodes of one patch: all eight around a node are its neighbours."""

NEAR = 1.1
"""Films of so many boundary films are contact on another grid, or by another tolerance."""


@dataclass(frozen=True, kw_only=True)
class MixedResult:
    """Film and contact of rough bodies; areas of a line contact are those of one metre of its length. Films
    are means and minima over film nodes within the Hertz ellipse or width, or None."""

    lambda_ratio: float | None
    """Central film that a formula predicts of smooth bodies, over Sq; None where Sq is 0."""
    Sq_nm: float
    """Rms of the heights within the Hertz semi-axes, about their mean."""
    contact_load_share: float
    film_load_share: float
    contact_area_m2: float
    contact_area_over_hertz: float
    patches: int
    """Areas of contact that hang together, by sides or by corners of the cells."""
    largest_patch_m2: float
    mean_film_nm: float | None
    minimum_film_nm: float | None
    valley_film_nm: float | None
    """Mean film where the heights are below their mean by more than Sq."""
    torn_share: float
    """Part of the nodes within the Hertz ellipse where the film is torn: cavitated."""
    per_metre: bool = False
    """Whether areas are those of one metre: of a line contact."""
    mean_gap_nm: float
    """Of all nodes within the ellipse, film, contact and torn film alike."""
    loaded_gap_nm: float
    """The same by their pressure: the gap on which the load rests. In results before 30 November 2026 of
    all nodes."""
    near_contact_load_share: float
    """Part of the load on films at most `NEAR` times as thick as the boundary film that contact keeps."""
    error: GapError | None = None
    """Bands about the mean gaps, the largest pressure and the loads; None of bodies without roughness."""
    solid_load_fraction: float
    """Part of the load that solids carry: P - p of contact nodes."""
    sealed_load_fraction: float
    """Part of the load on films and cavities that contact shuts in on all sides."""
    torn_filling: float | None = None
    """Mean part of the gap above the layers that cavities within the Hertz ellipse hold fluid in."""

    @property
    def hertz_region(self):
        """What the films are within, in words."""
        return "Hertz width" if self.per_metre else "Hertz ellipse"

    @property
    def area_unit(self):
        """Of areas in words and tables."""
        return "µm² in each metre" if self.per_metre else "µm²"


def mixed_result(problem, state):
    """The `MixedResult` of a state; None of smooth bodies (collective). Rank 0 has all nodes and tells the
    others: whatever the number of ranks the sums are the same."""
    grid, contact = problem.grid, problem.surfaced
    if contact.surface is None:
        return None
    heights = problem.heights - problem.hertz.contact.mean_height
    parts = state.P, state.H, state.status, state.p, state.full_part, heights
    kept, load = problem.scheme.contact_law.contact_gap, problem.load_share
    return grid.on_first(lambda *whole: measured(contact, grid.mesh, Fields(*whole), kept, load), *parts)


def measured(contact, mesh, fields, kept=0.0, load_share=1.0):
    """The `MixedResult` of the `Fields` of a whole `mesh`, heights about their mean, under `load_share`
    times the contact's load; contact keeps a gap of `kept`, in units of H."""
    hertz, solid = contact.hertz_under(load_share), fields.status == CONTACT
    inside, Sq = within_hertz(mesh, hertz.reach), hertz.contact.roughness
    film = inside & (fields.status == LUBRICATED)
    cell, square_metres = mesh.dX * mesh.dY, contact.cell_area(mesh)
    unit_nm = 1e9 * contact.film_scale
    nm, sizes = unit_nm * fields.H, patch_sizes(solid)
    mean_gap, loaded_gap = gaps_of(mesh, fields.P, fields.H, hertz.reach)
    near = (fields.status == LUBRICATED) & (fields.H <= NEAR * kept)
    torn, sealed = inside & (fields.status == CAVITATED), _sealed(solid)

    def share(pressure):
        return float(cell * pressure.sum() / hertz.integral)

    return MixedResult(
        lambda_ratio=hertz.contact.lambda_ratio,
        Sq_nm=1e9 * Sq,
        contact_load_share=share(fields.P[solid]),
        film_load_share=share(fields.P[is_fluid(fields.status)]),
        contact_area_m2=float(solid.sum() * square_metres),
        contact_area_over_hertz=float(solid.sum() * cell / hertz.area),
        patches=len(sizes),
        largest_patch_m2=float(max(sizes, default=0) * square_metres),
        mean_film_nm=_of_some(np.mean, nm[film]),
        minimum_film_nm=_of_some(np.min, nm[film]),
        valley_film_nm=_of_some(np.mean, nm[film & (fields.heights < -Sq) & (Sq > 0.0)]),
        torn_share=float(np.mean(fields.status[inside] == CAVITATED)),
        per_metre=mesh.is_line,
        mean_gap_nm=unit_nm * mean_gap,
        loaded_gap_nm=unit_nm * loaded_gap,
        near_contact_load_share=share(fields.P[near]),
        solid_load_fraction=share((fields.P - fields.p)[solid]),
        sealed_load_fraction=share(fields.P[sealed]),
        torn_filling=_of_some(np.mean, fields.filling[torn]),
    )


def _sealed(solid):
    """Nodes that are not `solid` and that solid nodes shut in, by sides of the cells: (ny, nx). A line
    contact is open at its two ends alone."""
    lines = solid if len(solid) > 1 else solid[0]
    return ndimage.binary_fill_holes(lines).reshape(solid.shape) & ~solid


def patch_sizes(solid):
    """Numbers of nodes in the patches of a mask (ny, nx)."""
    labels, _ = ndimage.label(solid, BESIDE)
    return np.bincount(labels.ravel())[1:].tolist()


def _of_some(function, values):
    return float(function(values)) if values.size else None
