"""The inlet of a contact: the zone upstream that builds its film, and the cells that a grid has in it."""

from math import sqrt

from mgehl.model import films
from mgehl.model.hertz import edge_gap_coefficient

SOFTEST = 3.0
"""Times that the inlet of soft bodies may be longer than the one by which speeds on coarse grids go:
without it rubber takes six times the work, with 2 soft contacts are lost."""


class Inlet:
    """That of a contact which adds `hertz`, `lubricant`, `speed`, `likeness` and its scales."""

    hardly_yields = False
    """The load is so light that the bodies hardly yield: the pressure is not that of Hertz."""

    @property
    def _edge_gap(self):
        return edge_gap_coefficient(self.hertz, self.reduced_modulus)

    @property
    def grubin_film(self):
        """Ertel-Grubin film in metres."""
        lubricant = self.lubricant
        return films.grubin(
            lubricant.pressure_viscosity, lubricant.viscosity, self.speed, self.hertz.a, self._edge_gap
        )

    @property
    def inlet_length(self):
        """Length of the zone that builds the film, in units of a; of layered bodies an estimate. Of bodies
        that hardly yield it is sqrt(2 R h), on which the gap is twice the film."""
        like, flooded = self.likeness, self.hardly_yields or self.hardly_stiffens
        return self.inlet_length_of(like.flooded_film if flooded else like.grubin_film)

    def inlet_length_of(self, film):
        """The same of a film in metres."""
        if self.hardly_yields:
            return sqrt(2.0 * self.likeness.radius_x * film) / self.x_scale
        return self._inlet_of(film)

    def _inlet_of(self, film):
        """s* = (h/C)^(2/3) of a film in metres."""
        return (film / self._edge_gap) ** (2.0 / 3.0)

    def cell_along_motion(self, mesh):
        """Length of a mesh's cell in units of a, as the truncation error along the motion has it."""
        return mesh.dX

    def inlet_cells(self, mesh):
        """Cells of a mesh that the inlet is long."""
        return self.inlet_length / self.cell_along_motion(mesh)

    def matched_speed(self, mesh, cells):
        """Lowest speed not below `speed` that keeps `cells` cells of a mesh along X in the inlet.

        s* grows with the square root of u, the inlet of bodies that hardly yield with u. That of Ertel and
        Grubin is too short for soft bodies and the speed too high: more of them are found so.
        """
        if self.hardly_yields:
            return self.speed * max(1.0, cells * mesh.dX / self.inlet_length)
        inlet = max(self._inlet_of(self.likeness.grubin_film), self.inlet_length / SOFTEST)
        return self.speed * max(1.0, (cells * mesh.dX / inlet) ** 2)
