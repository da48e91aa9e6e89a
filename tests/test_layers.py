import ast
from graphlib import CycleError, TopologicalSorter

import pytest
from places import ROOT

LAYERS = (
    "model", "discretization", "kinds", "grid", "multigrid", "solver", "output", "studies", "commands",
)  # fmt: skip
"""Lowest first. The modules beside them in mgehl (config, run, cli) stand above the layers."""
BENEATH = {"mgehl.errors", "mgehl.saying", "mgehl.version"}
"""What every layer may use; they use nothing but each other."""
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
    parts = name.split(".")
    return parts[1] if parts[0] == "mgehl" and len(parts) > 1 and parts[1] in LAYERS else None


in_layers = pytest.mark.parametrize("name", [name for name in MODULES if layer(name)])


@in_layers
def test_a_layer_imports_only_lower_layers_and_itself(name):
    allowed = LAYERS[: LAYERS.index(layer(name)) + 1]
    beside = BENEATH | USED_BESIDE.get(layer(name), set())
    if name == READS_A_CONFIGURATION:
        beside = beside | {"mgehl.config"}
    if layer(name) == "commands":
        beside = {each for each in MODULES if layer(each) is None} - {
            "mgehl", "mgehl.cli", "mgehl.__main__",
        }  # fmt: skip
    for imported in imports(name) - beside:
        if imported.startswith("mgehl."):
            assert layer(imported) in allowed, f"{name} imports {imported}"


@pytest.mark.parametrize("name", [name for name in MODULES if layer(name) in LAYERS[:3]])
def test_the_three_lowest_layers_know_neither_petsc_nor_mpi(name):
    roots = {imported.split(".")[0] for imported in imports(name)}
    assert not roots & {"petsc4py", "mpi4py", "mpi4py_fft", "slepc4py"}


def test_no_import_cycles():
    graph = {name: imports(name) & set(MODULES) - {name} for name in MODULES}
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        pytest.fail(f"import cycle: {' -> '.join(error.args[1])}")
