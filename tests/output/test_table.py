import pytest
from told import rows_of

from mgehl.cli import main
from mgehl.output.pictures.curves import curves
from mgehl.output.quantities import INSTANT, PASSAGE, QUANTITIES, Told, of_what, read_told, with_means
from mgehl.output.series import MEANS
from mgehl.output.table import collect, drawn, markdown, with_bands


def test_a_control_character_moves_no_cursor_and_markup_is_words():
    assert "\x1b" not in drawn([{"a": "\x1b[2J"}], ["a"])
    assert "[red]x" in drawn([{"a": "[red]x"}], ["a"])


def test_bands_are_shown_beside_no_more_digits_than_there_are():
    row = {"run": "a", "central nm": "12.1436", "central ± nm": "0.37", "mean gap nm": "13.7413",
           "mean gap ± nm": "0.0636", "minimum nm": "5.05", "minimum ± nm": ""}  # fmt: skip
    assert with_bands([row]) == [
        {"run": "a", "central nm": "12.1 ± 0.4", "mean gap nm": "13.74 ± 0.07", "minimum nm": "5.05"}
    ]


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    directory = tmp_path_factory.mktemp("runs")
    (directory / "load.csv").write_text("0,50\n1,5000\n")  # what does not change takes no Newton step
    film = ["motion.speed=1 m/s", "solver.start=film", "solver.error=false", "grid.nodes=65"]
    for name, settings in {
        "line": ["contact.kind=line", *film[:3], "grid.nodes=257"],
        "ball": film,
        "dry": ["discretization.contact_model=dry", "grid.nodes=65"],
        "dry line": ["contact.kind=line", "discretization.contact_model=dry", "grid.nodes=65"],
        "wedge": ["contact.kind=wedge", "motion.speed=1 m/s", "grid.nodes=65"],
        "time": [*film, "time.end=0.1 ms", f"contact.load={directory / 'load.csv'}"],
    }.items():
        words = [f"--set={each}" for each in settings]
        assert main(["run", *words, "--quiet", "--out", str(directory / name)]) == 0
    return directory


def test_a_row_for_each_run_of_any_kind(runs):
    rows = {row["run"]: row for row in collect(runs / name for name in ("ball", "line", "dry", "wedge"))}
    assert {tuple(row) for row in rows.values()} == {tuple(rows["ball"])}
    assert all(row["converged"] == "yes" for row in rows.values())
    assert float(rows["ball"]["central nm"]) > 100.0 and rows["ball"]["lambda"] == ""
    assert rows["dry"]["central nm"] == "" and with_bands(collect([runs / "dry line"]))
    assert float(rows["dry"]["contact/Hertz area"]) == pytest.approx(1.0, abs=0.1)
    assert float(rows["wedge"]["load N"]) > 0.0 and rows["line"]["load N"] == ""


def test_a_run_in_time_counts_its_newton_steps(runs):
    """Its steps in time were called so, and each took four times as long."""
    (row,), history = collect([runs / "time"]), rows_of(runs / "time" / "history.csv")
    assert int(row["Newton steps on finest"]) == sum(int(each["newton_steps"]) for each in history[1:])
    assert row["most GMRES iterations"] == "" and float(row["us a step and node"]) > 0.0
    assert float(row["rolling friction"]) > 0.0 and row["numbers of"] == INSTANT


def test_runs_of_a_bearing_have_the_speed_that_follows_and_their_lambda(tmp_path):
    """Both columns were empty, and nothing could be drawn against the speed."""
    ball = [
        "body_1.diameter=20 mm", "body_2.radius_x=50 mm", "body_1.roughness=30 nm",
        "body_2.roughness=40 nm", "grid.nodes=65", "solver.error=false", "solver.start=film",
    ]  # fmt: skip
    names = [str(tmp_path / name) for name in ("slow", "fast")]
    for name, turns in zip(names, (600, 1200), strict=True):
        settings = [f"--set={each}" for each in (*ball, f"motion.ring_rotation={turns} rpm")]
        assert main(["run", "--quiet", "--out", name, *settings]) == 0
    slow, fast = collect(names, ["motion.speed", "motion.ring_rotation"])
    assert float(fast["motion.speed"]) == pytest.approx(2.0 * float(slow["motion.speed"]), rel=1e-9)
    assert float(slow["lambda"]) == pytest.approx(float(slow["central nm"]) / 50.0, rel=1e-3)
    figure = curves([read_told(name) for name in names], "motion.speed")
    assert len(figure.axes[0].lines[0].get_xdata()) == 2


def test_a_run_in_time_is_told_by_its_means():
    """In the tables was its last instant, without a word: a wave in the contact, or beside it."""
    means = {name: {"value": float(i), "between_passages": 0.1 * i} for i, name in enumerate(MEANS)}
    instant = {"central_film_nm": 99.0, "moes_film": {"central": 3.5}}
    instant["mixed"], instant["error"] = {"lambda_ratio": 3.0, "Sq_nm": 20.0}, {"reason": "of an instant"}
    error = {"means": {"friction": 0.2}}
    told = Told({}, with_means(instant | {"time": {"means": means, "error": error, "Sq_nm": 10.0}}))
    assert [told.number(QUANTITIES[name].path) for name in MEANS] == list(range(len(MEANS)))
    assert told.number("contact.load_fraction") == told.number("mixed.contact_load_share")
    assert told.number("friction.coefficient_band") == pytest.approx(0.6 + 0.2)
    assert told.result["mixed"]["error"]["mean_nm"] is None  # passages alone tell no band
    assert told.result["error"]["reason"] == "of an instant"
    assert (told.result["moes_film"], told.result["mixed"]["lambda_ratio"]) == (None, 6.0)
    assert [of_what(each) for each in (told.result, {"time": {"means": {}}}, {})] == [PASSAGE, INSTANT, ""]
    for time in ({}, {"time": None}, {"time": {"means": {}}}):
        assert with_means(instant | time) == instant | time


def test_columns_without_room_are_drawn_of_rows_that_have_something_there():
    """After all the names of a row: of a sweep over two keys the one that failed could not be told."""
    rows = [
        {"u": str(k), "load": "10", "film": "100", "why": "no answer at all" * (k == 2)} for k in (1, 2)
    ]
    wide, below = drawn(rows, ["u", "load", "film", "why"], width=30, names=2).split("\n\n")
    assert len(wide.splitlines()) == 4
    assert below.splitlines()[2].split(maxsplit=2) == ["2", "10", "no answer at all"]


def test_a_key_s_column_is_shown_with_its_unit():
    rows = [{"run": "a", "motion.speed": "0.5", "grid.nodes": "65", "central nm": "12"}]
    head = markdown(rows, list(rows[0])).splitlines()[0]
    assert head == "| run | motion.speed, m/s | grid.nodes | central nm |"
