"""What README shows is what the code and the runs' files say."""

import csv
import os
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from mgehl.cli import main, read
from mgehl.commands.keys import describe_keys
from mgehl.config import config_from_tables, load_config

ROOT = Path(__file__).resolve().parent.parent
README = (ROOT / "README.md").read_text()
FIRST_CASE, OWN_LAWS, SURFACE = re.findall(r"```toml\n(.*?)```", README, flags=re.DOTALL)


def test_keys_are_those_of_the_code():
    assert f"```text\n{describe_keys()}\n```" in README


def test_table_is_the_one_the_runs_wrote():
    assert (ROOT / "runs" / "tables" / "short.md").read_text().strip() in README


def test_table_of_bands_is_the_one_the_study_wrote():
    assert (ROOT / "runs" / "tables" / "error-bands.md").read_text().strip() in README


def test_first_case_is_a_valid_configuration():
    assert config_from_tables(tomllib.loads(FIRST_CASE)).contact.load == pytest.approx(250.0)


def test_own_laws_are_a_valid_configuration(tmp_path, capsys):
    """They are compared with their differences before a run, and by `mgehl check`."""
    shutil.copy(ROOT / "configs" / "my_laws.py", tmp_path)
    (tmp_path / "own.toml").write_text(OWN_LAWS)
    assert main(["check", str(tmp_path / "own.toml"), "--set", "grid.nodes=65"]) == 0
    assert "valid, a point contact" in capsys.readouterr().out


def test_the_surface_is_a_valid_configuration(tmp_path, capsys):
    (tmp_path / "ground.txt").write_text(40 * "0 1 2 1 0 1 1 2\n")
    (tmp_path / "rough.toml").write_text(SURFACE)
    assert main(["check", str(tmp_path / "rough.toml"), "--set", "grid.nodes=65"]) == 0
    assert "ground.txt': 8 x 40 points" in capsys.readouterr().out


@pytest.mark.parametrize("path", sorted((ROOT / "configs").glob("*.toml")), ids=lambda path: path.stem)
def test_shipped_configurations_are_valid(path):
    load_config(path)


@pytest.mark.parametrize("path", re.findall(r"configs/\w+\.toml", README))
def test_named_configurations_exist(path):
    assert (ROOT / path).exists()


SHELL = [
    line.split("  #")[0].strip()
    for block in re.findall(r"```sh\n(.*?)```", README, flags=re.DOTALL)
    for line in block.splitlines()
]
COMMANDS = [line for line in SHELL if "mgehl" in line and not line.startswith(("make", "eval", "pip"))]
STUDIES = [line for line in COMMANDS if " study " in line or " bench" in line]


@pytest.mark.parametrize("line", STUDIES)
def test_studies_are_read_as_they_are_written(line):
    """Tests of their own run them; here their words are read."""
    words = shlex.split(line)
    read(words[words.index("mgehl") + 1 :])


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """A directory with the first case's my.toml and the configurations."""
    path = tmp_path_factory.mktemp("readme")
    (path / "my.toml").write_text(FIRST_CASE)
    (path / "configs").symlink_to(ROOT / "configs")
    return path


def small(line):
    """The command on 65 nodes."""
    line = re.sub(r"grid\.nodes=\d+", "grid.nodes=65", line)
    if " run " in line and "--resume" not in line and "grid.nodes" not in line:
        line = re.sub(r"(run \S+)", r"\1 --set grid.nodes=65", line)
    return re.sub(r"^mgehl ", f"{shlex.quote(sys.executable)} -m mgehl ", line)


def test_commands_run_in_their_order(place):
    """Each as it stands, but on 65 nodes; a command leaves behind what the next one reads."""
    environment = {k: v for k, v in os.environ.items() if not k.startswith(("OMPI_COMM", "PMIX_", "PRTE_"))}
    lines = [line for line in COMMANDS if line not in STUDIES]
    assert len(lines) >= 10
    for line in lines:
        done = subprocess.run(
            shlex.split(small(line)),
            cwd=place,
            env=environment,
            capture_output=True,
            text=True,
            timeout=120,
        )
        assert done.returncode == 0, f"{small(line)}\n{done.stdout}{done.stderr}"


def test_python_runs(place, monkeypatch, capsys):
    """The example, in the same directory."""
    monkeypatch.chdir(place)
    (block,) = re.findall(r"```python\n(import mgehl.*?)```", README, flags=re.DOTALL)
    exec(compile(block, "README.md", "exec"), {})
    assert "CONVERGED" in capsys.readouterr().out


def test_errors_of_the_schemes_are_those_of_the_study():
    """Its largest ones at 2, 4 and 8 cells, and the convolutions at 4."""
    rows = {
        (row["couette"], row["mean"], row["cells"]): row
        for row in csv.DictReader((ROOT / "runs/tables/accuracy-summary.csv").open())
    }
    schemes = tuple(f"| {couette} | " for couette in ("1B", "2B", "3B"))
    shown = [line.strip("| ").split(" | ") for line in README.splitlines() if line.startswith(schemes)]
    assert len(shown) == len(rows) // 3
    for couette, mean, *numbers in shown:
        own = [rows[couette, mean.split()[0], cells] for cells in ("2", "4", "8")]
        expected = [row[f"largest {film} error %"] for film in ("central", "minimum") for row in own]
        assert numbers == [*expected, own[1]["convolutions"]]
