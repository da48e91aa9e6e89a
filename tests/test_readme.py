"""What README shows is what the code and the runs' files say."""

import re
import tomllib
from pathlib import Path

import pytest

from mgehl.commands.keys import describe_keys
from mgehl.config import config_from_tables, load_config

ROOT = Path(__file__).resolve().parent.parent
README = (ROOT / "README.md").read_text()


def test_keys_are_those_of_the_code():
    assert f"```text\n{describe_keys()}\n```" in README


def test_table_is_the_one_the_runs_wrote():
    assert (ROOT / "runs" / "tables" / "short.md").read_text().strip() in README


def test_first_case_is_a_valid_configuration():
    (block,) = re.findall(r"```toml\n(.*?)```", README, flags=re.DOTALL)
    assert config_from_tables(tomllib.loads(block)).contact.load == pytest.approx(250.0)


@pytest.mark.parametrize("path", sorted((ROOT / "configs").glob("*.toml")), ids=lambda path: path.stem)
def test_shipped_configurations_are_valid(path):
    load_config(path)


@pytest.mark.parametrize("path", re.findall(r"configs/\w+\.toml", README))
def test_named_configurations_exist(path):
    assert (ROOT / path).exists()
