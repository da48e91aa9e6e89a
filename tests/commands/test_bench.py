import json

import pytest

from mgehl.cli import main

pytestmark = pytest.mark.usefixtures("empty_directory")
WEDGE = ["bench", "--case", "wedge-257", "--repeat", "1"]


def test_a_benchmark_is_printed_written_and_compared(capsys, tmp_path):
    assert main([*WEDGE, "--json", "old.json"]) == 0
    out = capsys.readouterr().out
    for word in ("wedge-257", "convolutions", "memory MiB", "deflection", "Krylov", "I/O"):
        assert word in out
    (timing,) = json.loads((tmp_path / "old.json").read_text())["timings"]
    assert timing["case"] == "wedge-257" and timing["time"]["wall"] > 0.0

    assert main([*WEDGE, "--compare", "old.json"]) == 0
    table = capsys.readouterr().out.split("times those of old.json:\n")[1].strip().splitlines()
    assert table[0].split() == ["wedge-257"]
    numbers = {line.rsplit(maxsplit=1)[0]: float(line.split()[-1]) for line in table[2:]}
    assert {"memory", "wall", "cpu", "Krylov"} <= numbers.keys() and 0.5 < numbers["memory"] < 2.0


@pytest.mark.parametrize(
    "arguments, parts",
    [(["--case", "frobnicate"], ["--case frobnicate", "film-257"]), (["--repeat", "0"], ["--repeat 0"]),
     (["--compare", "missing.json"], ["missing.json", "cannot be read"]),
     (["--compare", "/dev/zero"], ["/dev/zero", "is no file"]),
     (["--compare", "two.json"], ["two.json", "2 ranks"]),
     (["--compare", "empty.json"], ["empty.json: no benchmark"]),
     (["--compare", "other.json"], ["other.json: no benchmark"]),
     (["--compare", "old.json"], ["old.json: no benchmark"])],
)  # fmt: skip
def test_mistakes_are_one_line_before_anything_is_timed(refused, tmp_path, arguments, parts):
    two, old = '{"ranks": 2, "versions": {}, "timings": []}', '{"ranks": 1, "timings": [{"case": "a"}]}'
    for name, text in {"two": two, "empty": "", "other": "{}", "old": old}.items():
        (tmp_path / f"{name}.json").write_text(text)
    line = refused("bench", *arguments)
    assert all(part in line for part in parts)
