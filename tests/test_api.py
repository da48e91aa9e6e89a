import signal
import subprocess
import sys
import time
from dataclasses import replace
from warnings import catch_warnings, simplefilter

import numpy as np
import pytest
from mpi4py import MPI
from places import CONFIGS
from processes import ended, own_environment
from told import refusal

import mgehl

FILM = {"grid.nodes": 65, "motion.speed": "1 m/s", "solver.start": "film"}


@pytest.fixture(scope="module")
def film():
    return mgehl.solve(mgehl.load(None, FILM), MPI.COMM_SELF)


def test_with_other_keys_units_are_read_and_the_first_one_stays():
    config = mgehl.load(None, FILM)
    slower = config.with_({"motion.speed": "400 mm/s", "grid.nodes": 129})
    assert (slower.motion.speed, slower.grid.nodes, config.motion.speed) == (0.4, 129, 1.0)
    assert slower == mgehl.load(None, FILM | {"motion.speed": "400 mm/s", "grid.nodes": 129})
    assert config.with_({}) == config


@pytest.mark.filterwarnings("error")
def test_an_array_is_a_sequence():
    config = mgehl.load(None, FILM)
    assert config.with_({"grid.x": np.array([-3.0, 2.0])}) == config.with_({"grid.x": (-3.0, 2.0)})


def test_settings_may_be_sections():
    flat = {"grid.nodes": 65, "motion.speed": 2.0}
    assert mgehl.load(settings={"grid": {"nodes": 65}, "motion.speed": 2.0}) == mgehl.load(settings=flat)
    assert mgehl.load(None, "grid.nodes=65") == mgehl.load(None, ["grid.nodes=65"])
    said = refusal(mgehl.load().with_, None, error=mgehl.ConfigError)
    assert said == 'settings = None: must be {"section.key": value, ...}'


def test_what_a_file_does_not_give_is_warned_of(tmp_path):
    """And what it gives is not; without a file all is the paper's."""
    (tmp_path / "my.toml").write_text("contact.radius_x = 0.01\nmotion.speed = 1.0\n")
    said = "my.toml: not given: .*contact.radius_y: 0.0127 m is the paper's"
    with pytest.warns(UserWarning, match=said) as told:
        mgehl.load(tmp_path / "my.toml", {"contact.load": 100.0})
    assert len(told) == 1 and not any(key in str(told[0].message) for key in ("radius_x", "load", "speed"))
    with catch_warnings():
        simplefilter("error", UserWarning)
        mgehl.load(None, FILM), mgehl.load(CONFIGS / "wavy.toml")


def test_what_is_unusual_is_warned_of():
    config = mgehl.load(None, FILM | {"motion.slide_to_roll": 20.0, "solver.error": False})
    with pytest.warns(UserWarning, match="unusual: motion.slide_to_roll = 20: .* not in per cent"):
        assert mgehl.solve(config).summary.converged


class TestShown:
    def test_on_one_screen(self, film):
        heading, *words = repr(film).splitlines()
        assert heading == "<mgehl.Solution: Point contact, 1 m/s, 800 N, 65 × 65 nodes>"
        assert words[0].startswith("CONVERGED") and len(words) < 24

    def test_in_a_notebook_with_its_picture(self, film):
        html = film._repr_html_()
        assert "1 m/s" in html and "CONVERGED" in html and "data:image/png;base64," in html
        assert "image/png" not in replace(film, fields=None)._repr_html_()

    def test_in_a_figure(self, film):
        assert [axes.get_title() for axes in film.plot("film").axes]
        assert film.plot().axes
        with pytest.raises(mgehl.UserError, match="no picture 'heat' of this contact: it has lines, film"):
            film.plot("heat")


class TestKept:
    def test_what_is_saved_is_read_and_a_start(self, film, tmp_path):
        path = film.save(tmp_path / "runs" / "film")
        again = mgehl.read(path)
        np.testing.assert_array_equal(again.film, film.film)
        assert again.summary == film.summary and again.config == film.config
        assert (path / "picture.png").exists() and isinstance(again, mgehl.Solution)
        with pytest.raises(mgehl.UserError, match="exists: force=True replaces"):
            film.save(path)
        assert film.save(path, force=True) == path

    def test_what_is_no_run_is_one_line(self, tmp_path):
        refusal(mgehl.read, tmp_path)

    def test_as_xarray(self, film):
        data = film.to_xarray()
        np.testing.assert_array_equal(data.film, film.film)
        assert data.film.dims == ("y", "x") and data.film.units == "m" and data.attrs["converged"] == "yes"
        assert float(data.central_film_nm) == film.summary.central_film_nm
        center = data.pressure.sel(x=0, y=0, method="nearest")
        assert float(center) == pytest.approx(film.pressure[32, int(np.abs(film.x).argmin())])


SCRIPT = """
import mgehl
class Spoken:
    def __getattr__(self, name):
        return lambda *_: print("under way", flush=True)
import mgehl.output.terminal as terminal
terminal.SILENT = Spoken()
%s
mgehl.solve(mgehl.load(None, {"grid.nodes": 257, "motion.speed": "0.05 m/s", "solver.start": "film"}))
"""


@pytest.mark.parametrize("ask", ["", "import mpi4py.MPI, petsc4py.PETSc"], ids=["", "petsc awake"])
def test_ctrl_c_is_a_keyboard_interrupt_and_no_word_of_petsc(ask):
    """A script is told by Python; PETSc's handler would print its banner and end with 59."""
    process = subprocess.Popen(
        [sys.executable, "-c", SCRIPT % ask], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        env=own_environment(), start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )  # fmt: skip
    assert "under way" in process.stdout.readline()
    time.sleep(0.3)
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=120)
    assert process.returncode == -signal.SIGINT  # a shell says 130
    assert err.splitlines()[-1] == "KeyboardInterrupt: stopped by Ctrl-C; nothing is kept"
    assert "PETSC" not in err and len(err.splitlines()) < 10


def test_a_run_directory_is_a_start(film, tmp_path):
    config = film.config.with_({"motion.speed": "0.9 m/s"})
    starts = str(film.save(tmp_path / "film")), film
    by_path, by_itself = (mgehl.solve(config, MPI.COMM_SELF, start=start) for start in starts)
    np.testing.assert_array_equal(by_path.film, by_itself.film)


@pytest.mark.parametrize(
    "call, words",
    [(lambda film: mgehl.solve({"grid.nodes": 65}), "the path of a configuration; keys are for mgehl.load"),
     (lambda film: mgehl.solve(film.config, start=3), "start: is of type int; must be a Solution or a run"),
     (lambda film: mgehl.solve(film.config, start="nowhere"), "nowhere: is no run directory"),
     (lambda film: mgehl.sweep(film.config, {}, "d"), "names no key")],
)  # fmt: skip
def test_what_it_does_not_take_is_one_line(film, call, words):
    with pytest.raises(mgehl.UserError, match=words) as caught:
        call(film)
    assert "\n" not in str(caught.value)


def test_importing_does_not_wake_petsc():
    """PETSc takes the options of the command line, which are read after the import."""
    code = "import sys, mgehl; sys.exit('petsc4py.PETSc' in sys.modules or 'matplotlib' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], timeout=60).returncode == 0


def test_arrays_are_copies(film):
    film.status[:] = 0
    assert film.status.any() and film.heights is None
    assert film in [film] and film != mgehl.Solution.of(film)


def test_a_contact_without_a_file_has_the_papers_scheme_and_this_is_said():
    with pytest.warns(UserWarning, match="with its first-order scheme"):
        paper = mgehl.load(settings={"contact.load": 30.0})
    own = mgehl.Config().with_({"contact.load": 30.0})
    assert (paper.discretization.couette, own.discretization.couette) == ("1B", None)


@pytest.mark.parametrize("call", [lambda: mgehl.load(""), lambda: mgehl.solve(None)], ids=["", "None"])
def test_no_file_is_no_configuration(call):
    refusal(call, error=mgehl.ConfigError)


ON_TWO = """
import mgehl
from mpi4py import MPI
config = mgehl.Config().with_({"grid.nodes": 65, "motion.speed": "1 m/s", "solver.error": False})
film = mgehl.solve(config)
again = mgehl.solve(config, start=film if MPI.COMM_WORLD.rank == 0 else None)
assert again.summary.converged and (again.film is None) == (MPI.COMM_WORLD.rank == 1)
if MPI.COMM_WORLD.rank == 1:
    raise RuntimeError("a mistake of the script")
mgehl.solve(config)
"""


def test_a_script_that_fails_on_one_rank_ends_on_all(tmp_path):
    script = tmp_path / "script.py"
    script.write_text(ON_TWO)
    done = ended(["mpiexec", "-n", "2", sys.executable, str(script)], timeout=120)
    assert done.returncode == 1 and "RuntimeError: a mistake of the script" in done.stderr
