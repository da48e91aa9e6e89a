from mpi4py import MPI
from told import rows_of

from mgehl.output.study_directory import StudyRecord
from mgehl.studies import error, passages, rough
from mgehl.studies.study import Study


def test_films_of_a_random_contact(tmp_path):
    asked = StudyRecord("error", (65,), 1, {}, cases=2, seed=3)
    error.run(Study(tmp_path, MPI.COMM_SELF, asked, speak=False))
    rows, bands = rows_of(tmp_path / "cases.csv"), rows_of(tmp_path / "bands.csv")
    assert [row["contact"] for row in rows] == list(error.draw(2, 3))
    assert [row["nodes"] for row in rows] == ["65", "65"]

    told = {row["of"]: int(row["bands"]) for row in bands}
    assert list(told) == ["central", "minimum", "largest pressure", "friction"]
    assert told["central"] == told["minimum"] == 2 and told["friction"] >= told["largest pressure"]
    kept = [row["largest pressure limit GPa"] for row in rows if "±" in row["largest pressure GPa"]]
    assert told["largest pressure"] == len(kept)


def test_bands_of_a_random_run_in_time(tmp_path, monkeypatch):
    monkeypatch.setattr(passages, "COURSES", {})
    monkeypatch.setattr(passages, "LASTS", 1.01)
    asked = StudyRecord("passages", (65,), 1, {}, cases=1, seed=5)
    passages.run(Study(tmp_path, MPI.COMM_SELF, asked, speak=False))
    rows, bands = rows_of(tmp_path / "passages.csv"), rows_of(tmp_path / "passages-bands.csv")
    assert {row["case"] for row in rows} == set(passages.draw(1, 5)) < set(passages.draw(2, 5))
    names = [row["of"] for row in rows]
    assert names == [row["of"] for row in bands] and "mean_gap_nm of a passage" in names


def test_bands_of_random_rough_contacts(tmp_path, monkeypatch):
    monkeypatch.setattr(rough, "GRIDS", {"line": (129, 257), "point": (65, 129)})
    asked = StudyRecord("rough", (), 1, {}, cases=2, seed=4)
    rough.run(Study(tmp_path, MPI.COMM_SELF, asked, speak=False))
    rows, bands = rows_of(tmp_path / "cases.csv"), rows_of(tmp_path / "bands.csv")
    drawn = rough.draw(2, 4)
    assert [kind for kind, _ in drawn.values()] == ["line", "point"]
    assert {row["contact"] for row in rows} <= set(drawn) and rows
    for row in rows:
        value, _, half_width = row["friction"].partition(" ± ")
        if half_width:
            off = abs(float(row["friction limit"]) - float(value))
            assert row["friction band/error"].endswith("!") == (off > float(half_width))
    kinds = {row["of"].rpartition(", ")[2] for row in bands}
    assert kinds == {drawn[row["contact"]][0] for row in rows} and len(bands) == 6 * len(kinds)
