import json
from shutil import copytree, rmtree
from types import SimpleNamespace

import h5netcdf
import numpy as np
import pytest
from mpi4py import MPI
from places import names_in
from told import counting, rows_of

import mgehl
import mgehl.run as run_module
from mgehl.cli import main
from mgehl.config import load_config
from mgehl.errors import ConfigError, UserError
from mgehl.studies import study
from mgehl.studies.points import axis_of, points_of

FILM = ["--set", "grid.nodes=65", "--set", "solver.error=false", "--set", "solver.start=film"]
SPEEDS = "motion.speed=0.5..2 m/s:3"
STUDY = SimpleNamespace(failures=0)
SWEEP = ["sweep", *FILM, "--quiet", "--over", SPEEDS, "--out"]


@pytest.fixture(scope="module")
def film(tmp_path_factory):
    directory = tmp_path_factory.mktemp("sweeps") / "film"
    assert main([*SWEEP, str(directory)]) == 0
    return directory


def table(directory):
    return rows_of(directory / "sweep.csv")


def array(directory, name):
    with h5netcdf.File(directory / "sweep.nc", "r") as file:
        return file[name][()]


def test_it_leaves_runs_a_table_an_array_curves_and_a_page(film):
    assert names_in(film) == {
        "report.html", "runs", "study.json", "sweep.csv", "sweep.md", "sweep.nc", "sweep.png",
    }  # fmt: skip
    paths = (film / "runs" / name / "result.json" for name in ("001", "002", "003"))
    results = [json.loads(path.read_text()) for path in paths]
    assert [row["motion.speed"] for row in table(film)] == ["0.5", "1.25", "2"]
    assert array(film, "central_film_nm").tolist() == [each["central_film_nm"] for each in results]
    with h5netcdf.File(film / "sweep.nc", "r") as file:
        assert file["motion_speed"].attrs["units"] == "m/s"
        assert file["central_film_nm"].dimensions == ("motion_speed",)
    page = (film / "report.html").read_text()
    assert "Study sweep" in page and "branches" not in page


def test_a_point_from_its_neighbours_is_the_one_from_nothing(film):
    config = load_config(None, {"grid.nodes": 65, "solver.error": False, "solver.start": "film"})
    for point, speed in enumerate((0.5, 1.25, 2.0)):
        cold = mgehl.solve(config.with_({"motion.speed": speed}), MPI.COMM_SELF).result
        assert array(film, "central_film_nm")[point] == pytest.approx(cold.central_film_nm, rel=1e-6)


@pytest.mark.parametrize(
    "settings, over",
    [(["surface.kind=waviness", "surface.wavelength_x=100 um"], ["surface.amplitude=10..20 nm:2"]),
     (["lubricant.oil=M100"], ["lubricant.temperature=40,60 degC"]), ([], ["moes.M=20,50", "moes.L=5,10"])],
)  # fmt: skip
def test_what_is_swept_need_not_be_given_besides(settings, over, monkeypatch, tmp_path):
    points = []
    monkeypatch.setattr("mgehl.studies.sweep.swept", lambda *args: points.extend(args[3]) or STUDY)
    words = [*(f"--set={each}" for each in settings), *(f"--over={each}" for each in over)]
    assert main(["sweep", *words, "--out", str(tmp_path / "s")]) == 0
    assert len(points) == 2 ** len(over)


def test_killed_and_resumed_it_has_the_same_table(film, tmp_path, monkeypatch):
    run = study.run
    monkeypatch.setattr(study, "run", counting(run, iter(range(2))))
    assert main([*SWEEP, str(tmp_path / "film")]) != 0
    assert not (tmp_path / "film" / "sweep.csv").exists()
    monkeypatch.setattr(study, "run", run)
    assert main([*SWEEP, str(tmp_path / "film"), "--resume"]) == 0
    for name in ("sweep.csv", "sweep.md"):
        assert (tmp_path / "film" / name).read_bytes() == (film / name).read_bytes()


def test_what_is_there_is_not_solved_again_nor_taken_for_another(film, refused, monkeypatch):
    monkeypatch.setattr(study, "run", None)
    assert main([*SWEEP, str(film), "--resume"]) == 0
    others = {
        "0.6..2 m/s:3": "001 is of another configuration, motion.speed = 0.5 and not 0.6",
        "0.5,1.25 m/s": "003 is of a longer sweep",
    }
    for speeds, why in others.items():
        words = [f"motion.speed={speeds}" if word == SPEEDS else word for word in SWEEP]
        assert why in refused(*words, str(film), "--resume")


def test_shear_that_no_oil_bears_is_told_of_a_sweep_too(tmp_path, capsys):
    stiff = ["--set=motion.slide_to_roll=0.5", "--set=lubricant.pressure_viscosity=3e-8"]
    words = ["sweep", *FILM, *stiff, "--over=motion.speed=1,2 m/s", "--out", str(tmp_path / "s")]
    assert main(words) == 0
    assert "in 2 of 2 points: no oil bears more than some 300 MPa" in capsys.readouterr().out


def test_points_of_a_file_that_has_changed_are_solved_anew(tmp_path, capsys):
    law, directory = tmp_path / "law.py", tmp_path / "sweep"
    words = ["sweep", *FILM, "--set", f"contact.surface={law}:waves", "--over", "motion.speed=1,2 m/s"]
    words += ["--quiet", "--out", str(directory)]
    files = []
    for height in (2e-8, 1e-8):
        law.write_text(
            f"import numpy as np\n\n\ndef waves(x, y):\n    return {height} * np.cos(2e4 * x + 0.0 * y)\n"
        )
        assert main([*words, *(["--resume"] if files else [])]) == 0
        files.append((directory / "runs" / "001" / "laws" / "law.py").read_bytes())
    assert files[0] != files[1] == law.read_bytes()
    assert f"001: is solved anew, for {law} changed" in capsys.readouterr().err
    assert len(list((directory / "runs" / "001").iterdir())) == 6  # no remains


def test_a_point_that_fails_is_said_and_passed(tmp_path, capsys, monkeypatch):
    run, starts = study.run, []

    def failing(case, path, comm, watch, start):
        starts.append(start)
        if path.name == "002":
            raise UserError("no memory")
        return run(case, path, comm, watch, start)

    monkeypatch.setattr(study, "run", failing)
    assert main([*SWEEP, str(tmp_path / "film")]) == 1
    assert "1.25 m/s: not solved: no memory" in capsys.readouterr().err
    first, second, third = starts
    assert first is None and second is not None and third.last.config.motion.speed == 0.5
    assert np.isnan(array(tmp_path / "film", "central_film_nm")).tolist() == [False, True, False]
    assert [row["why not"] for row in table(tmp_path / "film")] == ["", "no memory", ""]


def test_what_nothing_leads_to_is_found_from_the_point_after_it(tmp_path, monkeypatch):
    """A sweep that began at its hard end lost a point that its neighbour leads to at once."""
    begin, hurried = run_module.begin, []

    def first_fails(task):
        hurried.append(task)
        return begin(task.limited(max_steps=1 if len(hurried) == 1 else 200))

    monkeypatch.setattr(run_module, "begin", first_fails)
    assert main([*SWEEP, str(tmp_path / "film")]) == 0
    assert [row["run"] for row in table(tmp_path / "film")] == ["001-again", "002", "003"]
    assert names_in(tmp_path / "film" / "runs") == {"001", "001-again", "002", "003"}
    assert main([*SWEEP, str(tmp_path / "film"), "--resume"]) == 0 and len(hurried) == 2


def test_what_is_unusual_is_said_once(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(study, "run", lambda *case: (_ for _ in ()).throw(UserError("not asked")))
    over = ["--over", "motion.speed=100,300,400 m/s", "--out", str(tmp_path / "fast")]
    (tmp_path / "my.toml").write_text("contact.radius_x = 0.01\n")
    assert main(["sweep", str(tmp_path / "my.toml"), *FILM, *over]) == 1
    said = " ".join(capsys.readouterr().out.split())
    assert said.count("unusual from point 002 on: motion.speed = 300 m/s: machines have 0 to 200") == 1
    assert "400 m/s: machines" not in said
    assert "not given: contact.load: 800 N is the paper's" in said
    assert "not given: motion.speed" not in said and "not given: contact.radius_x" not in said


@pytest.mark.parametrize(
    "text, values",
    [("1..5 mm/s:3", [0.001, 0.003, 0.005]), ("1e-4..1 m/s:5", [1e-4, 1e-3, 1e-2, 0.1, 1.0]),
     ("1..0.01 m/s:3", [1.0, 0.1, 0.01]), ("log(1..4 m/s:3)", [1.0, 2.0, 4.0]),
     ("lin(1..101 m/s:3)", [1.0, 51.0, 101.0]), ("50,100,200 mm/s", [0.05, 0.1, 0.2]),
     ("1 m/s,2 mm/s", [1.0, 0.002]), ("1,2", [1.0, 2.0])],
)  # fmt: skip
def test_ranges_and_lists(text, values):
    assert axis_of(load_config(), "motion.speed", text).values == pytest.approx(values)


def test_one_value_is_no_sweep():
    with pytest.raises(ConfigError, match="fewer than two values"):
        axis_of(load_config(), "motion.speed", 0.1)


@pytest.mark.parametrize("quote", "\"'")
def test_values_may_stand_in_quotes_as_those_of_set_do(film, quote):
    quoted = SPEEDS.replace("=", f"={quote}") + quote
    assert main([quoted if word == SPEEDS else word for word in [*SWEEP, str(film), "--resume"]]) == 0


def test_several_keys_are_a_snake_there_and_back():
    config = load_config()
    axes = [axis_of(config, "motion.speed", [1.0, 2.0, 3.0]), axis_of(config, "contact.load", [50, 60])]
    there = [(0, 0), (1, 0), (2, 0), (2, 1), (1, 1), (0, 1)]
    points = points_of(config, axes, both_ways=True)
    assert [point.place for point in points] == there + there[::-1]
    assert [point.way for point in points] == 6 * [0] + 6 * [1]
    assert points[3].config.motion.speed == 3.0 and points[3].config.contact.load == 60.0


@pytest.mark.parametrize(
    "words, said",
    [
        (["motion.speed"], "must be section.key=VALUES"),
        (["motion.speed=1e-4..1:20"], "needs a unit, such as m/s"),
        (["motion.speed=1..1 m/s:20"], "is empty"),
        (["motion.speed=1..2 m/s:0"], "is empty"),
        (["motion.speed=1..2 m/s"], "must be as"),
        (["motion.speed=fast,slow"], "must be as"),
        (["motion.speed=1..2 kg:3"], "wrong unit"),
        (["motion.speed=1,2 mm/s,3"], "give each number its unit, or all of them one at the end"),
        (["motion.speed=1,2 m/s,3 mm/s"], "give each number its unit"),
        (["motion.speed=log(1..2 m/s:3"], "must be as"),
        (["motion.speed=1..2 m/s:3)"], "must be as"),
        (["motion.speed=1e-30..1 m/s:3"], "must be at least 1e-12"),
        (["motion.speed=1"], "fewer than two"),
        (["motion.speed=1,1"], "same value twice"),
        (["contact.load=950,1,050 N"], "050 is no number"),
        (["motion.angle=log(0..10 deg:3)"], "log needs ends above 0"),
        (["motion.spede=1,2"], "unknown key; did you mean motion.speed?"),
        (["lubricant.viscosity_law=barus,roelands"], "only keys with a number"),
        (["solver.error=1,0"], "only keys with a number"),
        (["time.end=1,2"], "[time]"),
        (["grid.nodes=65,100"], "must be 2^k + 1"),
        (["motion.speed=1,2", "motion.speed=3,4"], "motion.speed: is given twice"),
        (["motion.speed=1..2 m/s:200", "contact.load=1..2 N:200"], "more than 10000 points"),
    ],
)  # fmt: skip
def test_bad_input_is_one_line(words, said, tmp_path, refused):
    over = [part for word in words for part in ("--over", word)]
    assert said in refused("sweep", *over, "--out", str(tmp_path / "new"))
    assert not (tmp_path / "new").exists()


def test_collect_takes_keys_and_plot_draws_against_one(film, tmp_path, capsys, refused):
    runs = sorted(map(str, (film / "runs").iterdir()))
    assert main(["collect", *runs, "--columns", "run,motion.speed,contact.load,central nm"]) == 0
    assert "| 001 | 0.5 | 800 |" in capsys.readouterr().out
    assert main(["collect", *runs, str(film)]) == 0  # a pattern of the shell may name anything
    assert f"left out: {film}: is a sweep or a study" in capsys.readouterr().err
    drawn = "--against", "motion.speed", "--format", "png", "--out", str(tmp_path)
    assert main(["plot", *runs, *drawn]) == 0
    assert (tmp_path / "against-motion.speed.png").stat().st_size > 10000
    capsys.readouterr()
    for key, said in {
        "motion.angle": "is 0 in all", "contact.kind": "has no number",
        "motion.sped": "did you mean motion.speed",
    }.items():  # fmt: skip
        assert said in refused("plot", *runs, "--against", key, "--out", str(tmp_path))


def test_from_python(film):
    config = load_config(None, {"grid.nodes": 65, "solver.error": False, "solver.start": "film"})
    found = mgehl.sweep(config, {"motion.speed": "0.5..2 m/s:3"}, film)
    assert found.central_film_nm.sel(motion_speed=1.25) == array(film, "central_film_nm")[1]


def test_a_way_back_from_nothing_says_so(tmp_path, capsys):
    """The same solve twice was read as: no hysteresis."""
    heights = "surface.amplitude=2,8 nm"  # in a film of 270 nm
    rough = ["--set", "surface.kind=waviness", "--set", "surface.wavelength_x=100 um"]
    out = str(tmp_path / "both")
    assert main(["sweep", *FILM, *rough, "--over", heights, "--both-ways", "--out", out]) == 0
    assert "1 of 2 points on the way back were solved from nothing" in capsys.readouterr().out
    speeds = ["--over", "motion.speed=1,1.1 m/s", "--both-ways", "--out", str(tmp_path / "near")]
    assert main(["sweep", *FILM, *speeds]) == 0
    assert "from nothing" not in capsys.readouterr().out


def test_a_run_that_is_damaged_is_named_and_a_sweep_is_no_run(film, tmp_path, capsys):
    copy = tmp_path / "copy"
    copytree(film, copy)
    assert main(["plot", str(copy)]) == 2
    assert f"is a sweep or a study, whose runs are {copy}/runs/*" in capsys.readouterr().err
    fields = copy / "runs" / "002" / "fields.h5"
    fields.write_bytes(fields.read_bytes()[:1000])
    assert main([*SWEEP, str(copy), "--resume"]) != 0
    assert f"without {fields.parent} it is solved anew" in capsys.readouterr().err
    rmtree(fields.parent)
    assert main([*SWEEP, str(copy), "--resume"]) == 0 and table(copy) == table(film)
