"""The picture of a wedge bearing: map of the pressure and its centre line."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)
import numpy as np  # noqa: E402

from mgehl.discretization.status import CONTACT  # noqa: E402
from mgehl.output.center_line import center_line  # noqa: E402
from mgehl.output.picture import PRESSURE, STYLE  # noqa: E402

SOLID = "0.45"


def draw(path, solution):
    """Write the picture of a `Solution` to `path`."""
    mesh, fields = solution.mesh, solution.fields
    with plt.rc_context(STYLE):
        figure, axes = plt.subplots(1, 2, figsize=(10.5, 3.9), layout="constrained")
        image = pressure_map(axes[0], mesh, fields)
        figure.colorbar(image, ax=axes[0], label="P = m$^2$p/($\\eta$u), 1/mm")
        axes[1].plot(*center_line(mesh, fields), color=PRESSURE)
        axes[1].axhline(0.0, color="0.8", linewidth=0.8, zorder=0)
        axes[1].set(xlabel="X, mm", ylabel="P, 1/mm", title="centre line", xlim=mesh.edges)
        figure.suptitle(_title(solution))
        figure.savefig(path)
        plt.close(figure)


def pressure_map(axes, mesh, fields, limits=None):
    """Draw P over the pad, solid grey; return the image for a colour bar."""
    solid = fields.status == CONTACT
    P = np.ma.masked_where(solid, fields.P)
    low, high = limits or (float(P.min()), float(P.max()))
    image = axes.pcolormesh(
        mesh.X, mesh.Y, P, cmap="viridis", vmin=low, vmax=high, shading="nearest", rasterized=True
    )
    axes.set_facecolor(SOLID)
    axes.set(xlabel="X, mm", ylabel="Y, mm", aspect="equal", title="pressure (solid grey)")
    return image


def _title(solution):
    bearing, mesh = solution.contact, solution.mesh
    what = "no pillar" if bearing.pillar == "none" else f"{bearing.pillar} pillar"
    exit = "blocked" if bearing.blocked_exit else "open"
    verdict = "converged" if solution.result.converged else "NOT converged"
    torn = ", film cavitates" if solution.result.cavitated_nodes else ""
    return f"wedge with {what}, exit {exit}{torn}, {mesh.nx} x {mesh.ny} nodes: {verdict}"
