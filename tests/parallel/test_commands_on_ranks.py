"""Commands that one rank executes: started on several they are done, and said, once.

Every rank runs every test, as in `test_ranks`.
"""

import pytest
from mpi4py import MPI
from told import status_of

from mgehl.cli import main

pytestmark = pytest.mark.parallel

COMM = MPI.COMM_WORLD
WEDGE = ["run", "--set", "contact.kind=wedge", "--set", "grid.nodes=65", "--quiet"]


@pytest.fixture
def directory(tmp_path_factory, monkeypatch):
    """Rank 0's empty directory, in which every rank is."""
    here = COMM.bcast(tmp_path_factory.mktemp("here"))
    monkeypatch.chdir(here)
    COMM.barrier()
    yield here
    COMM.barrier()


def said_once(capsys, status, *words):
    """Every rank ends with the status; rank 0 says one of its streams, which has the words."""
    found = status_of(*words)
    said = COMM.allgather(tuple(capsys.readouterr()))
    assert COMM.allgather(found) == [status] * COMM.size
    assert said[1:] == [("", "")] * (COMM.size - 1)
    out, err = said[0]
    assert (err.count("\n"), bool(out)) == ((0, True) if status == 0 else (1, False)), said[0]
    return out + err


@pytest.mark.parametrize(
    "words", [["keys"], ["check"], ["info"], ["completion", "bash"], ["--version"], []]
)
def test_what_is_told(directory, capsys, words):
    said_once(capsys, 0, *words)


def test_a_file_is_written_by_one_rank(directory, capsys):
    said_once(capsys, 0, "new", "mine.toml")
    assert "exists" in said_once(capsys, 2, "new", "mine.toml")


def test_a_run_is_read_by_one_rank(directory, capsys):
    assert main([*WEDGE, "--out", "wedge"]) == 0
    said_once(capsys, 0, "collect", "wedge", "--out", "table.csv")
    said_once(capsys, 0, "plot", "wedge", "--format", "png")
    said_once(capsys, 0, "report", "wedge")
    said_once(capsys, 0, "export", "wedge", "--to", "npz")
    assert "exists" in said_once(capsys, 2, "export", "wedge", "--to", "npz")


MISTAKES = [
    ["check", "nowhere.toml"], ["check", "--set", "grid.nodes=66"], ["info", "nowhere.toml"],
    ["report", "nowhere"], ["plot", "nowhere"], ["collect", "nowhere"],
    ["export", "nowhere", "--to", "npz"],
    ["new", "nowhere/mine.toml"], ["run", "-options_file", "nowhere"], ["run", "nowhere.toml"],
    ["run", "--resume", "nowhere"], ["run", "--start-from", "nowhere"], ["run", "--time-limit", "soon"],
    ["study", "line", "--nodes", "66"], ["bench", "--case", "nothing"], ["keys", "more"], ["nonsense"],
]  # fmt: skip


@pytest.mark.parametrize("words", MISTAKES, ids=" ".join)
def test_mistakes(directory, capsys, words):
    said_once(capsys, 2, *words)


class TestPicture:
    """The last rank draws it."""

    SMALL = ["run", "--set", "grid.nodes=65", "--quiet", "--no-error"]
    KINDS = {
        "ball": [*SMALL, "--set", "grid.x=[-1.9, 1.3]", "--set", "grid.y=[-1.5, 1.5]"],
        "line": [*SMALL, "--set", "contact.kind=line", "--set", "motion.speed=0.5"],
        "wedge": WEDGE,
    }

    @pytest.mark.parametrize("kind", KINDS)
    def test_it_is_the_one_that_is_drawn_from_the_files(self, directory, kind):
        assert main([*self.KINDS[kind], "--out", "here"]) in (0, 1)
        drawn = COMM.bcast((directory / "here" / "picture.png").read_bytes() if COMM.rank == 0 else None)
        if COMM.rank == 0:
            (directory / "here" / "picture.png").unlink()
        COMM.barrier()
        assert main(["run", "--resume", "here", "--quiet"]) in (0, 1)
        assert (directory / "here" / "picture.png").read_bytes() == drawn
