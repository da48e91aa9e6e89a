from mpi4py import MPI
from told import rows_of

from mgehl.output.study_directory import StudyRecord
from mgehl.studies import error, passages
from mgehl.studies.study import Study


def test_films_of_a_random_contact(tmp_path):
    asked = StudyRecord("error", (65,), 1, {}, cases=2, seed=3)
    error.run(Study(tmp_path, MPI.COMM_SELF, asked, speak=False))
    rows, bands = rows_of(tmp_path / "cases.csv"), rows_of(tmp_path / "bands.csv")
    assert [row["contact"] for row in rows] == list(error.draw(2, 3))
    assert [row["nodes"] for row in rows] == ["65", "65"]
    for row in rows:
        film, half_width = map(float, row["central nm"].split(" ± "))
        off = abs(float(row["central limit nm"]) - film)
        assert row["central band/error"].endswith("!") == (off > half_width)
    told = {row["of"]: int(row["bands"]) for row in bands}
    assert list(told) == ["central", "minimum", "largest pressure", "friction"]
    assert told["central"] == told["minimum"] == 2 and told["friction"] == told["largest pressure"]
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
    for row in rows:
        value, half_width = map(float, row["value"].split(" ± "))
        off = abs(float(row["limit"]) - value)
        assert row["band/error"].endswith("!") == (off > half_width)
