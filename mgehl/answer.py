"""A `Solution` in the hands of its user: shown in a notebook, drawn, saved, given to xarray."""

import base64
from dataclasses import fields
from html import escape
from os import PathLike
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from mgehl.errors import OutputError, UserError
from mgehl.output.solution import Solution as Solved

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure


class Solution(Solved):
    """A solved contact, as `mgehl.solve` and `mgehl.read` return it: `film` in m, `pressure` in Pa and
    `status`, (ny, nx), beside `x` and `y` in m; `summary` is all that result.json holds, `config` the
    `Config`. Fields, and what is made of them, are rank 0's; arrays are copies."""

    @classmethod
    def of(cls, solved: Solved) -> "Solution":
        """The same solution with what its user may want."""
        return cls(**{each.name: getattr(solved, each.name) for each in fields(Solved)})

    def __repr__(self) -> str:
        return f"<mgehl.Solution: {self._heading()}>\n{self.summary.words(verbose=False)}"

    def _repr_html_(self) -> str:
        """The heading, the answer in words, the picture of the run."""
        text = f"<h4>{escape(self._heading())}</h4><pre>{escape(self.summary.words(verbose=False))}</pre>"
        if self.fields is None:
            return text
        from mgehl.output.pictures.figures import run_picture

        image = base64.b64encode(run_picture(self)).decode()
        return f'{text}<img alt="{escape(self._heading())}" src="data:image/png;base64,{image}">'

    def _heading(self) -> str:
        heading: str = self.config.kind.heading(self)
        return heading.replace("\u00a0", " ")

    def to_xarray(self) -> "xarray.Dataset":
        """Fields in SI units over x and y, numbers as a sweep has them, the configuration as an attribute.

        What `mgehl export --to nc` writes, in memory. Raises UserError where xarray is not installed.
        """
        try:
            import xarray
        except ImportError as error:
            raise UserError(f"to_xarray needs xarray, which is not installed: {error}") from None
        from mgehl.output.export.netcdf import write_netcdf

        self._needs_fields("to_xarray")
        with TemporaryDirectory() as folder:
            path = Path(folder) / "fields.nc"
            write_netcdf(path, self)
            return xarray.load_dataset(path, engine="h5netcdf")

    def plot(self, kind: str = "lines") -> "Figure":
        """A matplotlib figure: lines, film, pressure, status, history, surface; where bodies slide shear,
        flash_1 and flash_2; of a run in time time, of a dry contact gap.

        Raises UserError for a kind that this contact does not have.
        """
        from mgehl.output.pictures.figures import figures

        self._needs_fields("plot")
        if not isinstance(kind, str):
            raise UserError(f"plot: kind must be one name, not {kind!r}")
        return figures(self, [kind])[0].figure

    def save(self, directory: str | PathLike[str], force: bool = False) -> Path:
        """Write a run directory, as `mgehl run` does; return its path. `mgehl.read` reads it.

        With `force` a result of mgehl's that is there is replaced. Raises OutputError where the directory
        exists or cannot be written.
        """
        from mgehl.run import save

        self._needs_fields("save")
        path = Path(directory)
        if path.exists() and not force:
            raise OutputError(f"{path} exists: force=True replaces a result of mgehl's")
        save(self, path)
        return path

    def _needs_fields(self, what: str) -> None:
        if self.fields is None:
            raise UserError(f"{what}: the whole grid's fields are on rank 0 alone")
