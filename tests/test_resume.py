import json
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from mpi4py import MPI
from places import CONFIGS, RUN_FILES, names_in
from processes import MGEHL, ended, own_environment
from told import status_of

from mgehl.config import load_config
from mgehl.kinds import contact_from, with_domain
from mgehl.output.checkpoint import begin_run, load, read_begun
from mgehl.output.stored import read_run
from mgehl.run import solve

FILM = ["--set", "grid.nodes=129", "--set", "motion.speed=0.5", "--set", "solver.start=film"]
"""Eight steps on 65 nodes, seven on 129."""
SOLVES = {"solve-0000.npz", "solve-0001.npz"}
"""Of `SMALL`: the film on 65 nodes, and on 33 for its band."""
TEXTS = {"configuration.toml", "history.csv", "result.json"}
BEGUN = {"begun.npz"}
"""What is solved, in the checkpoint."""
SMALL = ["--set", "grid.nodes=65", "--set", "motion.speed=0.5", "--set", "solver.start=film"]
ROUGH = [str(CONFIGS / "rough.toml"), "--set", "grid.nodes=65"]
ROUGH += ["--set", "solver.tolerance=1e-10"]
"""Film and contact on a rough ball: some twenty steps, by a linear solver that remembers those before. To a
tolerance by which runs whose sums round differently end with the same film."""
SIGNALS = ((signal.SIGTERM, "SIGTERM", 143), (signal.SIGINT, "Ctrl-C", 130), (signal.SIGHUP, "SIGHUP", 129))
ALWAYS = ["--save-every", "0.001"]

pytestmark = pytest.mark.usefixtures("empty_directory")


@pytest.fixture(scope="module")
def uninterrupted():
    """Function: the solution of settings, by a run that nothing stopped."""
    made = {}

    def make(settings):
        key = tuple(settings)
        if key not in made:
            made[key] = solve(configuration(settings), MPI.COMM_SELF)
        return made[key]

    return make


def configuration(words):
    path, words = (None, words) if words[0] == "--set" else (words[0], words[1:])
    return load_config(path, words[1::2])


def settled(config):
    return with_domain(config, contact_from(config))


def start(arguments, ranks=1):
    words = [*MGEHL, "run", *arguments]
    if ranks > 1:
        words = ["mpiexec", "-n", str(ranks), *words]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    return subprocess.Popen(words, env=own_environment(), **pipes)


def end(process):
    _, err = process.communicate(timeout=120)
    return process.returncode, [line for line in err.splitlines() if line.startswith("mgehl: ")]


def exit_status(*arguments):
    return status_of("run", *arguments, "--quiet")


def children(pid):
    return [int(each) for each in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


def has_begun(directory):
    return any((directory / name).exists() for name in ("fields.h5", "checkpoint/begun.npz"))


def assert_nothing_is_half_written(directory):
    """What is there under a name of its own can be read."""
    whole = {path.name for path in directory.glob("*") if not path.name.startswith(".part-")}
    assert whole <= RUN_FILES | {"checkpoint", ".mgehl-lock"}
    if (directory / "fields.h5").exists():
        read_run(directory)
    if (directory / "checkpoint" / "begun.npz").exists():
        for path in (directory / "checkpoint").glob("[!.]*.npz"):
            assert load(path, configuration_of(directory))


def configuration_of(directory):
    """What a run that goes on is solving, as its checkpoint has it."""
    return read_begun(directory).tables


def assert_same(directory, solution, steps=0):
    """Films to 1e-9 of the largest, the same status map; history of so many `steps` more or less."""
    read = read_run(directory)
    np.testing.assert_array_equal(read.status, solution.status)
    for name in ("film", "pressure"):
        found, known = getattr(read, name), getattr(solution, name)
        np.testing.assert_allclose(found, known, rtol=0.0, atol=1e-9 * known.max())
    assert abs(len(read.rows) - len(solution.rows)) <= steps
    assert read.result.converged == solution.result.converged
    assert names_in(directory) == RUN_FILES


class TestKills:
    """SIGKILL, eight times at random moments: after a line or two were said, and a while later."""

    @pytest.mark.parametrize("kills, ranks, seed", [(5, 1, 1), (3, 2, 2)])
    def test_nothing_is_lost(self, uninterrupted, tmp_path, kills, ranks, seed):
        chance, here, runs = random.Random(seed), tmp_path / "0", 1
        while kills:
            killed = self.killed(here, ranks, chance)
            assert_nothing_is_half_written(here)
            kills -= killed
            if not killed:  # it was faster
                assert_same(here, uninterrupted(FILM))
                here, runs = tmp_path / str(runs), runs + 1
        if not has_begun(here):
            assert exit_status(*FILM, "--out", str(here), "--force") == 0
        assert exit_status("--resume", str(here)) == 0  # on one rank, whatever it was before
        assert_same(here, uninterrupted(FILM))

    def killed(self, here, ranks, chance):
        """Whether a run, or one that goes on, was killed on its way."""
        anew = [*FILM, "--out", str(here), "--force"]
        arguments = ["--resume", str(here)] if has_begun(here) else anew
        process = start([*arguments, *ALWAYS, "--json-lines"], ranks)
        for _ in range(chance.choice([0, 1, 1, 2])):
            process.stdout.readline()
        time.sleep(chance.uniform(0.0, 0.15))
        # Ranks have process groups of their own; where one is killed, mpiexec ends the others.
        os.kill(chance.choice((ranks > 1 and children(process.pid)) or [process.pid]), signal.SIGKILL)
        status, said = end(process)
        assert said == [] and (status in (0, -signal.SIGKILL) or ranks > 1)
        return status != 0


class TestStops:
    def test_signals(self, uninterrupted, tmp_path):
        """One after the other: nothing of what was reached is done again."""
        here, cycles = tmp_path / "here", 0
        arguments = [*FILM, "--out", str(here)]
        for number, name, status in SIGNALS:
            process = start([*arguments, "--json-lines"])
            first = json.loads(process.stdout.readline())["cycle"]
            process.send_signal(number)
            said, err = process.communicate(timeout=60)
            line = f"mgehl: stopped by {name}; go on with: mgehl run --resume {here}\n"
            assert (process.returncode, err) == (status, line)
            record, _ = load(here / "checkpoint" / "under-way.npz", configuration_of(here))
            rows = record["progress"]["rows"]
            assert rows[cycles] == first and len(rows) == cycles + 1 + len(said.splitlines())
            cycles, arguments = len(rows), ["--resume", str(here)]
        assert exit_status("--resume", str(here)) == 0
        assert_same(here, uninterrupted(FILM))

    def test_a_limit_of_time(self, uninterrupted, tmp_path, capsys):
        here = tmp_path / "with a space"
        assert exit_status(*SMALL, "--out", str(here), "--time-limit", "1e-9") == 143
        for _ in range(2):
            assert exit_status("--resume", str(here), "--time-limit", "1e-6 ms") == 143
        err = capsys.readouterr().err.splitlines()
        assert len(err) == 3
        assert err[0].endswith(f"after 1e-09 s; go on with: mgehl run --resume '{here}'")
        assert exit_status("--resume", str(here)) == 0
        assert_same(here, uninterrupted(SMALL))

    @pytest.mark.parametrize("ranks", [1, 2])
    def test_a_rough_contact_goes_on_by_the_same_work(self, uninterrupted, tmp_path, ranks):
        """What was learnt of the linear systems is kept, for any number of ranks."""
        words = [*ROUGH, "--out", "here"]
        for _ in range(5):
            assert exit_status(*words, "--time-limit", "1e-9") == 143
            words = ["--resume", "here"]
        assert end(start([*words, "--quiet"], ranks)) == (0, [])
        whole = uninterrupted(ROUGH)
        assert_same(tmp_path / "here", whole, steps=0 if ranks == 1 else 2)
        work = read_run(tmp_path / "here").result.work
        # On two ranks sums round differently: 157 convolutions for 152.
        apart = 1e-12 if ranks == 1 else 0.1
        assert work.convolutions == pytest.approx(whole.result.work.convolutions, rel=apart)


class TestResume:
    def test_no_run(self, tmp_path, refused):
        assert "is no run directory" in refused("run", "--resume", "nowhere")
        (tmp_path / "empty").mkdir()
        assert "has no fields.h5 and no checkpoint" in refused("run", "--resume", "empty")
        assert not list((tmp_path / "empty").iterdir())

    @pytest.mark.parametrize("more", [["my.toml"], ["--set", "grid.nodes=65"], ["--out", "b"], ["--force"],
                                      ["--start-from", "b"]])  # fmt: skip
    def test_what_does_not_go_with_it(self, more, refused):
        assert "goes on as it began" in refused("run", *more, "--resume", "here")

    def test_checkpoints_that_cannot_be_gone_on_with(self, tmp_path, capsys, refused, monkeypatch):
        again = "run", "--resume", "here"
        here, kept = tmp_path / "here", tmp_path / "here" / "checkpoint" / "under-way.npz"
        assert exit_status(*SMALL, "--out", "here", "--time-limit", "1e-9") == 143
        capsys.readouterr()
        whole = kept.read_bytes()
        kept.write_bytes(whole[:-100])
        assert "is damaged" in refused(*again)
        assert kept.read_bytes() == whole[:-100]
        kept.write_bytes(whole)
        begun = here / "checkpoint" / "begun.npz"
        with begun.open("r+b") as file:
            file.seek(200)
            file.write(b"?")
        assert "begun.npz: is damaged" in refused(*again)
        begun.unlink()
        begin_run(here, configuration([*SMALL, "--set", "motion.speed=0.6"]))
        assert "was written for another configuration" in refused(*again)
        begun.unlink()
        begin_run(here, settled(configuration(SMALL)))
        with monkeypatch.context() as change:
            change.setattr("mgehl.output.checkpoint.VERSION", "99.0")
            assert "99.0 cannot go on with it" in refused(*again)
        assert exit_status("--resume", "here") == 0


class TestStartFrom:
    @pytest.fixture(scope="class")
    def finished(self, tmp_path_factory):
        path = tmp_path_factory.mktemp("finished") / "before"
        assert exit_status(*SMALL, "--out", str(path)) == 0
        return path

    @pytest.fixture
    def before(self, tmp_path, finished):
        return Path(shutil.copytree(finished, tmp_path / "before"))

    def test_it_goes_on_though_the_other_run_is_gone(self, before, uninterrupted):
        settings = [*SMALL, "--set", "motion.speed=0.6"]
        starting = [*settings, "--start-from", "before"]
        assert exit_status(*starting, "--out", "after") == 0
        assert exit_status(*starting, "--out", "parted", "--time-limit", "1e-9") == 143
        shutil.rmtree(before)
        assert exit_status("--resume", "parted") == 0
        whole, parted = read_run("after"), read_run("parted")
        np.testing.assert_array_equal(parted.fields.H, whole.fields.H)
        assert len(parted.rows) == len(whole.rows)

    def test_files_that_the_other_run_read_are_kept_with_it(self, tmp_path, monkeypatch):
        """A table of speed of its own was looked for among those of the run that started from it."""
        monkeypatch.chdir(tmp_path)
        for name, speed in (("first", 0.5), ("then", 0.51)):
            (tmp_path / f"{name}.csv").write_text(f"0,{speed}\n1,{speed}\n")
        in_time = ["--set", "time.end=1e-5", "--no-error"]
        assert exit_status(*SMALL, *in_time, "--set", "motion.speed=first.csv", "--out", "before") == 0
        starting = [*SMALL, *in_time, "--set", "motion.speed=then.csv", "--start-from", "before"]
        assert exit_status(*starting, "--out", "after") == 0
        assert exit_status(*starting, "--out", "parted", "--time-limit", "1e-9") == 143
        shutil.rmtree("before")
        (tmp_path / "first.csv").unlink()
        assert exit_status("--resume", "parted") == 0
        np.testing.assert_array_equal(read_run("parted").fields.H, read_run("after").fields.H)
        assert names_in(tmp_path / "parted") == names_in(tmp_path / "after")

    @pytest.mark.parametrize(
        "arguments, part",
        [
            (["--start-from", "nowhere", "--out", "new"], "nowhere: is no run directory"),
            ([*SMALL, "--start-from", "before", "--out", "before", "--force"],
             "is the run's own directory"),
            (["--start-from", "before", "--set", "contact.kind=line", "--out", "new"],
             "--start-from before: a point is no start for a line"),
            (["--start-from", "before", "--set", "contact.kind=wedge", "--out", "new"],
             "--start-from before: a point is no start for a wedge"),
        ],
    )  # fmt: skip
    def test_what_is_no_start(self, before, tmp_path, refused, arguments, part):
        assert part in refused("run", *arguments)
        assert names_in(before) == RUN_FILES and not (tmp_path / "new").exists()


def mounted(*words):
    """Whether root may mount here."""
    try:
        return subprocess.run(["mount", *words], capture_output=True).returncode == 0
    except FileNotFoundError:
        return False


class TestFullDisk:
    """A small disk; what was good before stays, and with more room the run goes on."""

    @pytest.fixture
    def disk(self, tmp_path):
        path = tmp_path / "disk"
        path.mkdir()
        options = ["-t", "tmpfs", "-o"]
        if not mounted(*options, "size=1m", "tmpfs", str(path)):
            pytest.skip("a small disk needs the right to mount one")

        def resize(size):
            assert mounted("-o", f"remount,size={size}", "tmpfs", str(path))
            return path

        yield resize
        subprocess.run(["umount", str(path)], check=True)

    @pytest.mark.parametrize(
        "size, save_every, there",
        [("40k", "0.001", BEGUN), ("300k", "0.001", {"under-way.npz", *BEGUN}),
         ("260k", "1000", {*TEXTS, *BEGUN, *SOLVES})],
    )  # fmt: skip
    def test_it_is_one_line_and_the_run_goes_on_later(self, disk, uninterrupted, size, save_every, there):
        here = disk(size) / "here"
        done = ended([*MGEHL, "run", *SMALL, "--out", str(here), "--quiet", "--save-every", save_every])
        assert done.returncode == 2 and done.stderr.count("\n") == 1, done.stderr
        assert done.stderr.startswith(f"mgehl: {here}") and "No space left on device" in done.stderr
        assert {path.name for path in here.rglob("*") if path.is_file()} == there
        assert_nothing_is_half_written(here)
        disk("4m")
        assert exit_status("--resume", str(here)) == 0
        assert_same(here, uninterrupted(SMALL))


class TestFailingRank:
    """One rank of two meets an error of its own at the third step; the other waits for it."""

    DRIVER = (
        "import os, signal, sys\n"
        "from mpi4py import MPI\n"
        "from mgehl import cli, errors\n"
        "from mgehl.output.checkpoint import Checkpoint\n"
        "def step(checkpoint, grid, position, step=Checkpoint.step):\n"
        "    if MPI.COMM_WORLD.rank == 1 and len(position.cycles) == 3:\n"
        "        {what}\n"
        "    step(checkpoint, grid, position)\n"
        "Checkpoint.step = step\n"
        "sys.exit(cli.main(sys.argv[1:]))\n"
    )

    def run(self, tmp_path, what):
        (tmp_path / "driver.py").write_text(self.DRIVER.format(what=what))
        words = [
            "mpiexec", "-n", "2", sys.executable, "driver.py", "run", *SMALL, "--quiet", "--out", "here",
        ]  # fmt: skip
        began, done = time.monotonic(), ended(words)
        return done.returncode, done.stderr, time.monotonic() - began

    def test_an_error_ends_all_with_its_message(self, tmp_path):
        status, err, seconds = self.run(tmp_path, "raise ArithmeticError('the second rank is ill')")
        assert status == 1 and seconds < 45.0
        (line,) = [line for line in err.splitlines() if line.startswith("mgehl")]
        assert line.startswith("mgehl: an error of mgehl's own: ArithmeticError: the second rank is ill")

    def test_a_signal_to_one_rank_stops_both(self, tmp_path):
        status, err, _ = self.run(tmp_path, "os.kill(os.getpid(), signal.SIGTERM)")
        assert status == 143
        (line,) = [line for line in err.splitlines() if line.startswith("mgehl")]
        assert line == "mgehl: stopped by SIGTERM; go on with: mgehl run --resume here"
        assert exit_status("--resume", "here") == 0
