"""What a number that steers the solver is worth: cases by chance, with other values of it.

    python tests/tools/steering.py                                      all numbers, and what each is
    python tests/tools/steering.py solver.cavitation.LOW 0.03 0.3       the present value beside others
        --study machine --cases 20 --nodes 129 --seed 7                 of these cases

Numbers are those that a module of the solver names in capitals. Judge on a seed that chose no number.
"""

import argparse
import ast
import sys
from importlib import import_module
from pathlib import Path

import numpy as np

import mgehl
from mgehl.config import config_from_tables
from mgehl.output.table import markdown
from mgehl.studies.study import merged

PACKAGE = Path(mgehl.__file__).parent
FOLDERS = "solver", "multigrid", "discretization"


def numbers():
    """(module.NAME, value, first line of what it is) of all numbers."""
    for path in sorted(path for folder in FOLDERS for path in (PACKAGE / folder).glob("*.py")):
        body = ast.parse(path.read_text()).body
        for statement, after in zip(body, [*body[1:], None], strict=True):
            for name in _names(statement):
                value = getattr(import_module(f"mgehl.{path.parent.name}.{path.stem}"), name)
                if isinstance(value, int | float) and not isinstance(value, bool):
                    yield f"{path.parent.name}.{path.stem}.{name}", value, _meaning(after)


def _names(statement):
    targets = statement.targets if isinstance(statement, ast.Assign) else ()
    named = (each for target in targets for each in ast.walk(target) if isinstance(each, ast.Name))
    return [each.id for each in named if each.id.isupper()]


def _meaning(statement):
    text = getattr(getattr(statement, "value", None), "value", "")
    return text.split("\n")[0] if isinstance(text, str) else ""


def put(number, value):
    """Let a number be a `value` wherever the package has it by that name."""
    module, _, name = f"mgehl.{number}".rpartition(".")
    before = getattr(import_module(module), name)
    for each in [each for title, each in sys.modules.items() if title.startswith("mgehl.")]:
        if getattr(each, name, None) is before:
            setattr(each, name, type(before)(value))


def row(value, study, cases, nodes, seed):
    """What becomes of the cases by a value."""
    drawn = import_module(f"mgehl.studies.{study}").draw(cases, seed)
    grid = {"grid": {"nodes": nodes}, "solver": {"error": False}}
    results = [mgehl.solve(config_from_tables(merged(each.tables, grid))).result for each in drawn]
    work = [each.work.convolutions for each in results]
    lost = [str(each.number) for each, found in zip(drawn, results, strict=True) if not found.converged]
    return {
        "value": f"{value:g}",
        "converged": f"{len(drawn) - len(lost)} of {len(drawn)}",
        "convolutions, mean": f"{np.mean(work):.0f}",
        "median": f"{np.median(work):.0f}",
        "not found": ", ".join(lost),
    }


def main():
    """List the numbers, or measure one."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("number", nargs="?")
    parser.add_argument("values", nargs="*", type=float)
    parser.add_argument("--study", default="mixed", choices=("mixed", "machine", "rollers"))
    for name, default in (("cases", 12), ("nodes", 65), ("seed", 1)):
        parser.add_argument(f"--{name}", type=int, default=default)
    asked = parser.parse_args()
    known = {name: value for name, value, _ in numbers()}
    if not asked.number:
        rows = [{"number": name, "value": f"{value:g}", "what": what} for name, value, what in numbers()]
        print(markdown(rows, list(rows[0])))
        return
    rows = []
    for value in (known[asked.number], *asked.values):
        put(asked.number, value)
        rows.append(row(value, asked.study, asked.cases, asked.nodes, asked.seed))
    print(markdown(rows, list(rows[0])))


if __name__ == "__main__":
    main()
