import shutil
import sys
from pathlib import Path

import pytest
from places import CONFIGS, content_of
from processes import ended

from mgehl.cli import main

RUNS = {
    "point": ["--set", "grid.nodes=65", "--set", "motion.speed=0.5 m/s", "--set", "solver.start=film"],
    "line": [str(CONFIGS / "line_contact.toml"), "--set", "grid.nodes=129"],
    "wedge": [str(CONFIGS / "wedge_square_pillar.toml"), "--set", "grid.nodes=65"],
}


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    here = tmp_path_factory.mktemp("runs")

    def directory(kind):
        if not (here / kind).exists():
            main(["run", *RUNS[kind], "--quiet", "--out", str(here / kind)])
        return here / kind

    return directory


@pytest.fixture
def run(runs, tmp_path):
    def copy(kind):
        return Path(shutil.copytree(runs(kind), tmp_path / "run"))

    return copy


@pytest.mark.parametrize("kind", RUNS)
def test_all_formats_of_a_run(kind, run, capsys):
    directory = run(kind)
    before = content_of(directory)
    assert main(["export", str(directory), "--to", "vts,nc,npz,csv"]) == 0
    written = [f"fields.{each}" for each in ("vts", "nc", "npz", "csv")]
    assert capsys.readouterr().out.split() == [str(directory / name) for name in written]
    after = content_of(directory)
    assert after.keys() == before.keys() | set(written) and before.items() <= after.items()


ON_A_FULL_DISK = """
import resource, signal, sys
from petsc4py import PETSc  # MPI has files of its own
from mgehl.cli import main
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (50000, 50000))
sys.exit(main(sys.argv[1:]))
"""


@pytest.mark.parametrize("name", ["vts", "nc", "npz", "csv"])
def test_a_full_disk_is_one_line_to_the_end_of_the_process(name, runs, tmp_path):
    """Of 65 x 65 nodes, more than any buffer holds. (PETSc's viewer and HDF5 have last words of theirs.)"""
    (tmp_path / f"a.{name}").write_text("mine")
    command = [sys.executable, "-c", ON_A_FULL_DISK, "export", str(runs("point")), "--to", name]
    command += ["--force", "--out", str(tmp_path / "a")]
    done = ended(command)
    assert done.returncode == 2, done.stderr
    assert "cannot be written" in done.stderr and done.stderr.count("\n") == 1
    assert [path.read_text() for path in tmp_path.iterdir()] == ["mine"]


@pytest.mark.parametrize(
    "words, said",
    [(["--to", "vtk"], "known are vts, nc, npz, csv"), (["--to", "vts", "--out", "a.nc"], "--out a.nc"),
     (["--to", "csv"], "exists: add --force")],
)  # fmt: skip
def test_mistakes_are_one_line(words, said, run, refused):
    directory = run("wedge")
    (directory / "fields.csv").write_text("mine")
    assert said in refused("export", str(directory), *words)
    assert (directory / "fields.csv").read_text() == "mine"
