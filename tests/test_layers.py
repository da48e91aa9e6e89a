"""The layers of mgehl import downwards only; mgehl/README.md lists every equation that the code names."""

import ast
import re
from dataclasses import fields
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

from mgehl.config import SECTIONS

ROOT = Path(__file__).resolve().parent.parent
LAYERS = (
    "model",
    "discretization",
    "kinds",
    "grid",
    "multigrid",
    "solver",
    "output",
    "studies",
    "commands",
)
"""Lowest first. The modules beside them in mgehl (config, run, cli) stand above the layers."""
BENEATH = {"mgehl.errors", "mgehl.saying", "mgehl.version"}
"""What every layer may use; they use nothing but each other."""
USERS_OF_OUTPUT = {"mgehl.run", "mgehl.api", "mgehl.answer"}
ABOVE_OUTPUT = ("output", "studies", "commands")
USED_BESIDE = {
    "kinds": {"mgehl.config_value"},
    "multigrid": {"mgehl.config_sections"},
    "solver": {"mgehl.config_sections"},
    "output": {"mgehl.config", "mgehl.config_value"},
    "studies": {"mgehl.run", "mgehl.config"},
}
"""Kinds declare keys, settings take the keys' defaults, runs are read back with their configuration,
studies make runs. Commands use what they need."""
READS_A_CONFIGURATION = "mgehl.solver.from_config"
"""The module of the solver that may know the configuration."""


def module_name(path):
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {module_name(path): path for path in sorted((ROOT / "mgehl").rglob("*.py"))}


def imports(name):
    """Modules that a module imports anywhere in its text, functions included."""
    found = set()
    for node in ast.walk(ast.parse(MODULES[name].read_text())):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{name} has a relative import, which these tests do not follow"
            # `from package import module` imports the module.
            modules = {f"{node.module}.{alias.name}" for alias in node.names} & set(MODULES)
            found |= modules or {node.module}
    return found


def layer(name):
    """The layer a module belongs to, or None."""
    parts = name.split(".")
    return parts[1] if parts[0] == "mgehl" and len(parts) > 1 and parts[1] in LAYERS else None


every_module = pytest.mark.parametrize("name", MODULES)
in_layers = pytest.mark.parametrize("name", [name for name in MODULES if layer(name)])


def test_every_package_is_a_known_layer():
    packages = {path.parent.name for path in (ROOT / "mgehl").glob("*/__init__.py")}
    assert packages == set(LAYERS)


@in_layers
def test_a_layer_imports_only_lower_layers_and_itself(name):
    allowed = LAYERS[: LAYERS.index(layer(name)) + 1]
    beside = BENEATH | USED_BESIDE.get(layer(name), set())
    if name == READS_A_CONFIGURATION:
        beside = beside | {"mgehl.config"}
    if layer(name) == "commands":
        beside = {each for each in MODULES if layer(each) is None} - {
            "mgehl",
            "mgehl.cli",
            "mgehl.__main__",
        }
    for imported in imports(name) - beside:
        if imported.startswith("mgehl."):
            assert layer(imported) in allowed, f"{name} imports {imported}"


@pytest.mark.parametrize("name", [name for name in MODULES if layer(name) in LAYERS[:3]])
def test_the_three_lowest_layers_know_neither_petsc_nor_mpi(name):
    roots = {imported.split(".")[0] for imported in imports(name)}
    assert not roots & {"petsc4py", "mpi4py", "mpi4py_fft", "slepc4py"}


def test_configuration_knows_only_the_three_lowest_layers():
    """It validates names against their tables; everything else must be able to do without PETSc."""
    parts = {"mgehl.config", "mgehl.config_file", "mgehl.config_sections", "mgehl.config_value"}
    used = {each for part in parts for each in imports(part) if each.startswith("mgehl")} - parts - BENEATH
    assert used and {layer(each) for each in used} <= set(LAYERS[:3])
    assert not {each for each in imports("mgehl.config_value") if each.startswith("mgehl")} - BENEATH
    assert not {each for each in imports("mgehl.config_file") if each.startswith("mgehl")}


@every_module
def test_output_is_used_by_the_run_the_command_line_and_the_studies_only(name):
    if layer(name) not in ABOVE_OUTPUT and name not in USERS_OF_OUTPUT:
        assert not any(layer(imported) == "output" for imported in imports(name))


@every_module
def test_studies_are_used_by_the_command_line_and_the_interface_only(name):
    if layer(name) not in ("studies", "commands") and name != "mgehl.api":
        assert not any(layer(imported) == "studies" for imported in imports(name))


def all_imports(name):
    """Modules of mgehl that a module cannot do without, through all that it imports."""
    found, ahead = set(), {name}
    while ahead:
        found |= ahead
        ahead = {each for one in ahead for each in imports(one) & set(MODULES)} - found
    return found - {name}


def test_a_solution_and_its_words_know_no_terminal_and_it_does_not_know_them():
    speaking = {"mgehl.output.terminal", "mgehl.output.progress"}
    assert not all_imports("mgehl.output.solution") & speaking
    assert "mgehl.output.words" in all_imports("mgehl.output.solution")
    assert "mgehl.output.words" not in all_imports("mgehl.output.terminal")


@pytest.mark.parametrize("name", [name for name in MODULES if layer(name) == "model"])
def test_the_model_says_no_key_of_the_configuration(name):
    keys = {f"{section}.{key.name}" for section, kind in SECTIONS.items() for key in fields(kind)}
    said = [node.value for node in ast.walk(ast.parse(MODULES[name].read_text()))
            if isinstance(node, ast.Constant) and isinstance(node.value, str)]  # fmt: skip
    assert [(key, text) for text in said for key in keys if key in text] == []


def test_no_import_cycles():
    graph = {name: imports(name) & set(MODULES) - {name} for name in MODULES}
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        pytest.fail(f"import cycle: {' -> '.join(error.args[1])}")


def equation_numbers(text):
    """Whole numbers of "31, 32", "27-34" or "49; Love 1929": the list up to the first other word."""
    numbers = set()
    for item in re.split(r",| and ", text.split(";")[0]):
        match = re.fullmatch(r"\s*(?:eqs?\.\s*)?(\d+)[a-d]?(?:\s*[-–]\s*(\d+))?\s*", item)
        if not match:
            break
        first, last = int(match[1]), int(match[2] or match[1])
        numbers |= set(range(first, last + 1))
    return numbers


TAGS = [
    (name, tag)
    for name, path in MODULES.items()
    for tag in sorted(set(re.findall(r"\[Liu eqs?\.\s*([^\]]*)\]", path.read_text())))
]


def table_of_equations(text):
    """Numbers in the first column of the page's table of equations."""
    lines = iter(text.splitlines())
    assert any(line.lower().startswith("| equation") for line in lines), "no table of equations"
    numbers = set()
    for line in lines:
        if not line.startswith("|"):
            break
        numbers |= equation_numbers(line.split("|")[1])
    return numbers


@pytest.mark.parametrize(
    "text, numbers",
    [
        ("26", {26}),
        ("31, 32", {31, 32}),
        ("27-34", set(range(27, 35))),
        ("49; Love 1929", {49}),
        ("26, in units of a^2/R", {26}),
        ("29a, 29b", {29}),
        ("---", set()),
    ],
)
def test_lists_of_equations_are_read(text, numbers):
    assert equation_numbers(text) == numbers


def test_tags_are_found():
    assert ("mgehl.discretization.couette", "9-14, 17, 18, 31, 32") in TAGS
    assert all(equation_numbers(tag) for _, tag in TAGS)


@pytest.mark.parametrize("name, tag", TAGS)
def test_equation_of_a_tag_is_in_the_table_of_the_page(name, tag):
    missing = equation_numbers(tag) - table_of_equations((ROOT / "mgehl" / "README.md").read_text())
    assert not missing, f"[Liu eq. {tag}] in {name}: the table of mgehl/README.md lacks {sorted(missing)}"
