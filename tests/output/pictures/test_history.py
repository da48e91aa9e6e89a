import pytest

from mgehl.errors import OutputError
from mgehl.output.pictures.history import history


def test_no_cycles(make_solution, drawn):
    with pytest.raises(OutputError, match="history.csv has no cycles"):
        drawn(history, make_solution(rows=[]))
