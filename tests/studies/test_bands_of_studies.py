"""Study error: what is drawn, how a band is judged, what is said of all."""

import csv

from mpi4py import MPI

from mgehl.studies import error
from mgehl.studies.study import Study


def read(path):
    with path.open() as file:
        return list(csv.DictReader(file))


def test_films_of_a_random_contact(tmp_path):
    error.run(Study(tmp_path, MPI.COMM_SELF, (65,), speak=False, wanted=2, seed=3))
    rows, bands = read(tmp_path / "cases.csv"), read(tmp_path / "bands.csv")
    assert [row["contact"] for row in rows] == list(error.draw(2, 3))
    assert [row["nodes"] for row in rows] == ["65", "65"]
    for row in rows:
        film, half_width = map(float, row["central nm"].split(" ± "))
        off = abs(float(row["central limit nm"]) - film)
        assert row["central band/error"].endswith("!") == (off > half_width)
    assert [(row["of"], row["bands"]) for row in bands] == [("central", "2"), ("minimum", "2")]
