import pytest

from mgehl.cli import main
from mgehl.config import KEYS, load_config
from mgehl.kinds import KINDS, kind_choice

pytestmark = pytest.mark.usefixtures("empty_directory")


@pytest.fixture
def written(tmp_path):
    def write(kind):
        assert main(["new", "mine", "--kind", kind]) == 0
        return (tmp_path / "mine.toml").read_text()

    return write


@pytest.mark.parametrize("kind", KINDS)
def test_every_key_that_means_something_is_there_with_its_meaning(kind, written):
    text = written(kind)
    flat = " ".join(line.removeprefix("# ") for line in text.splitlines())
    for name, key in KEYS.items():
        foreign = kind_choice(KINDS[kind]).means_nothing(name)
        assert (f"{key.metadata['help']} (" in flat) is not foreign, name


@pytest.mark.parametrize("kind, nodes", [("point", 65), ("line", 129), ("wedge", 65)])
def test_it_runs(kind, nodes, written, capsys):
    written(kind)
    assert main(["run", "mine.toml", "--set", f"grid.nodes={nodes}", "--quiet"]) == 0


def test_a_file_that_exists_is_refused_and_replaced_with_force(tmp_path, refused):
    mine = tmp_path / "mine.toml"
    mine.write_text("old")
    line = refused("new", "mine.toml")
    assert "mine.toml exists" in line and "--force" in line
    assert mine.read_text() == "old"
    assert main(["new", "mine.toml", "--force"]) == 0
    assert load_config(mine).contact.kind == "point"


@pytest.mark.parametrize("name", ["\udcff\udcfe", "two\nlines", "\x1b[2J"])
def test_a_name_that_no_text_holds(capsys, tmp_path, name):
    """Names of files are bytes; the page they stand in is a text, and one line."""
    assert main(["new", name]) == 0
    assert load_config(tmp_path / f"{name}.toml").contact.kind == "point"
    out, err = capsys.readouterr()
    assert err == "" and len(out.splitlines()) == 1 and out.strip().isprintable()
