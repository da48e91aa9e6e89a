import re
import shlex
import shutil
import tomllib
from dataclasses import fields

import page_tables
import pytest
from mpi4py import MPI
from places import CONFIGS, ROOT
from processes import MGEHL, ended

import mgehl
from mgehl.cli import main, read
from mgehl.config import SECTIONS, config_from_tables, load_config

PAGES = {
    name: (ROOT / name).read_text()
    for name in (
        "README.md", "configs/README.md", "mgehl/README.md", "runs/README.md", "tests/README.md",
        "CONTRIBUTING.md",
    )
}  # fmt: skip
README, CASES = PAGES["README.md"], PAGES["configs/README.md"]
(FIRST_CASE,) = re.findall(r"```toml\n(.*?)```", README, flags=re.DOTALL)
SURFACE, OWN_LAWS, FRICTION = re.findall(r"```toml\n(.*?)```", CASES, flags=re.DOTALL)


def links():
    for name, text in PAGES.items():
        for target in re.findall(r"\]\(([^)]+)\)", text):
            if not target.startswith("http"):
                yield name, target


def anchors(text):
    heads = re.findall(r"^#+ (.*)$", re.sub(r"```.*?```", "", text, flags=re.DOTALL), flags=re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-") for head in heads}


@pytest.mark.parametrize("page, target", sorted(set(links())))
def test_links_lead_somewhere(page, target):
    path, _, anchor = target.partition("#")
    file = (ROOT / page).parent / path if path else ROOT / page
    assert file.exists()
    assert not anchor or anchor in anchors(file.read_text())


def test_mgehl_keys_lists_every_key(capsys):
    """Pages send there. A section that takes the keys of another one has a single line."""
    assert main(["keys"]) == 0
    listed = {line.split()[0] for line in capsys.readouterr().out.splitlines()}
    for name, section in SECTIONS.items():
        assert f"{name}.*" in listed or {f"{name}.{key.name}" for key in fields(section)} <= listed


@pytest.mark.parametrize("page", page_tables.PAGES, ids=lambda path: path.parent.name)
def test_tables_of_findings_are_those_that_commands_wrote(page):
    assert page_tables.filled(page.read_text()) == page.read_text()


def test_the_verdict_shown_is_that_of_the_first_case():
    """As a run prints it without --verbose."""
    (shown,) = re.findall(r"```text\n(CONVERGED.*?)```", README, flags=re.DOTALL)
    solution = mgehl.solve(config_from_tables(tomllib.loads(FIRST_CASE)), MPI.COMM_SELF)
    words, lines = solution.result.words(verbose=False).splitlines(), shown.splitlines()
    assert lines == words[: len(lines)] and len(lines) == len(words) - 1
    assert "  work: " in words[-1]


@pytest.mark.parametrize(
    "example, said",
    [(OWN_LAWS, "valid, a point contact"), (SURFACE, "ground.txt': 8 x 40 points"), (FRICTION, "friction")],
    ids=["laws", "surface", "friction"],
)  # fmt: skip
def test_examples_of_the_page_of_cases_are_valid_configurations(tmp_path, capsys, example, said):
    """Laws are compared with their differences before a run, and by `mgehl check`."""
    shutil.copy(CONFIGS / "my_laws.py", tmp_path)
    (tmp_path / "ground.txt").write_text(40 * "0 1 2 1 0 1 1 2\n")
    (tmp_path / "mine.toml").write_text(example)
    assert main(["check", str(tmp_path / "mine.toml"), "--set", "grid.nodes=65"]) == 0
    assert said in capsys.readouterr().out


def shell_lines(text):
    """Commands of a page, each as it is to be typed; of a loop its body with the loop's first word."""
    for block in re.findall(r"```sh\n(.*?)```", text, flags=re.DOTALL):
        for line in block.splitlines():
            command = line.split("  #")[0].strip()
            if loop := re.fullmatch(r"for (\w+) in (\S+) .*?; do (.*); done", command):
                command = loop[3].replace(f"${loop[1]}", loop[2])
            if "mgehl " in command and not command.startswith(("make", "eval", "pip", "ruff")):
                yield command


def is_only_read(line):
    return any(word in line for word in (" study ", " sweep ", "runs/sweep-", " bench ", " pytest"))


COMMANDS = [line for page in PAGES.values() for line in shell_lines(page) if "pytest" not in line]
READ = [line for line in COMMANDS if is_only_read(line)]
TUTORIAL = re.search(r"## Six cases\n(.*?)\n## ", CASES, flags=re.DOTALL)[1]
RUN = [line for line in COMMANDS if line not in READ and line not in list(shell_lines(TUTORIAL))]


@pytest.mark.parametrize("line", [*READ, *shell_lines(TUTORIAL)])
def test_commands_are_read_as_they_are_written(line):
    """Studies have tests of their own, and the cases of the tutorial take minutes: their words are read."""
    words = shlex.split(line)
    command = read(words[words.index("mgehl") + 1 :])
    if command.command == "run":
        load_config(ROOT / command.config, command.settings)


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    path = tmp_path_factory.mktemp("readme")
    (path / "my.toml").write_text(FIRST_CASE)
    (path / "configs").symlink_to(ROOT / "configs")
    return path


def small(line):
    line = re.sub(r"grid\.nodes=\d+", "grid.nodes=65", line)
    if " run " in line and "--resume" not in line and "grid.nodes" not in line:
        line = re.sub(r"(run \S+)", r"\1 --set grid.nodes=65", line)
    return re.sub(r"^mgehl ", f"{shlex.join(MGEHL)} ", line)


def test_commands_run_in_their_order(place):
    """Each as it stands, but on 65 nodes; a command leaves behind what the next one reads."""
    assert len(RUN) >= 8
    for line in RUN:
        done = ended(shlex.split(small(line)), cwd=place)
        assert done.returncode == 0, f"{small(line)}\n{done.stdout}{done.stderr}"


def test_python_runs(place, monkeypatch, capsys):
    """The example, in the same directory."""
    monkeypatch.chdir(place)
    (block,) = re.findall(r"```python\n(import mgehl.*?)```", CASES, flags=re.DOTALL)
    exec(compile(block, "configs/README.md", "exec"), {})
    assert "CONVERGED" in capsys.readouterr().out
