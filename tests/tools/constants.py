"""What each number that steers a solve does: one is changed at a time, and a few small cases are solved.

    python tests/tools/constants.py                  every number (hours)
    python tests/tools/constants.py SQUEEZE bands    those of this name, or of the module of this name

Numbers are found in the source: whatever has capitals for a name and a number for a value at the top of a
module of `LAYERS`. So the tool knows those that were added since, and none that is gone.

A row of the table is a value, a column a case. In it stand the convolutions, or "=" where the value changes
nothing. "!" is a case that did not converge, "~" one whose answer differs by more than a millionth of its
largest pressure. Each value is solved by a copy of the package in a process of its own.
"""

import ast
import os
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
LAYERS = ("discretization", "multigrid", "solver")

FACTORS = (0.3, 3.0)
"""By which a number is changed; a whole number to the next one at the least."""

ROUGH = {"grid.nodes": 129, "motion.speed": "0.6 mm/s"}
CASES = {
    "film": ("full_film", {"grid.nodes": 129, "motion.speed": 0.1}),
    "thick": ("moes_200_10", {"grid.nodes": 129}),
    "contact": ("point_contact", {"grid.nodes": 129}),
    "mixed": ("point_contact", {"grid.nodes": 129, "motion.speed": 1e-3}),
    "geometric": ("full_film", {"grid.nodes": 65, "discretization.face_mobility": "geometric"}),
    "line": ("line_contact", {}),
    "rough": ("rough", ROUGH),
    "no layers": ("rough", ROUGH | {"contact.boundary_film": 0.0}),
    "wedge": ("wedge_square_pillar", {"grid.nodes": 65, "discretization.cavitation": True}),
    "coated": ("coated", {"grid.nodes": 65}),
}
"""Configurations and what is set in them."""


@dataclass(frozen=True)
class Number:
    """A number at the top of a module; `place` is where its value stands in the text: line, from, to."""

    path: Path
    name: str
    value: float
    place: tuple

    @property
    def title(self):
        return f"{self.path.stem}.{self.name}"

    def others(self):
        """The values that are tried."""
        if isinstance(self.value, float):
            return [factor * self.value for factor in FACTORS]
        low, high = (round(factor * self.value) for factor in FACTORS)
        return [min(low, self.value - 1), max(high, self.value + 1)]

    def changed(self, text, value):
        """The text of its module with another value."""
        lines, (line, start, end) = text.splitlines(keepends=True), self.place
        lines[line] = f"{lines[line][:start]}{value!r}{lines[line][end:]}"
        return "".join(lines)


def numbers():
    """Every `Number`, by module."""
    for path in sorted(path for layer in LAYERS for path in (ROOT / "mgehl" / layer).glob("*.py")):
        for node in ast.parse(path.read_text()).body:
            if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
                name, value = node.targets[0].id, node.value
                if name.isupper() and isinstance(value, ast.Constant) and type(value.value) in (int, float):
                    place = value.lineno - 1, value.col_offset, value.end_col_offset
                    yield Number(path.relative_to(ROOT), name, value.value, place)


def answers(number=None, value=None):
    """{case: (convolutions, converged, pressures)} by a copy of the package; None where a case broke."""
    with tempfile.TemporaryDirectory() as place:
        for folder in ("mgehl", "configs"):  # with what is compiled
            shutil.copytree(ROOT / folder, Path(place) / folder)
        if number:
            module = Path(place) / number.path
            module.write_text(number.changed(module.read_text(), value))
        surroundings = os.environ | {"PYTHONPATH": place}
        subprocess.run([sys.executable, __file__, "--solve", place], env=surroundings, check=True)
        found = {}
        for case in CASES:
            path, found[case] = Path(place) / f"{case}.npz", None
            if path.exists():
                with np.load(path) as file:
                    found[case] = float(file["work"]), bool(file["converged"]), file["P"]
        return found


def solve_all(place):
    """Solve all cases by the package that Python finds; leave their answers in a folder."""
    import mgehl

    for case, (name, settings) in CASES.items():
        try:
            solution = mgehl.solve(mgehl.load(Path(place) / "configs" / f"{name}.toml", settings))
        except Exception as error:  # what a wild value breaks is an answer, too
            print(f"    {case}: {type(error).__name__}: {str(error)[:100]}", file=sys.stderr)
            continue
        result = solution.summary
        work = result.work.convolutions if hasattr(result, "work") else result.linear_iterations
        np.savez(Path(place) / f"{case}.npz", work=work, converged=result.converged, P=solution.fields.P)


def cell(found, usual):
    """What a table says of an answer beside the usual one."""
    if found is None or usual is None:
        return "broke" if found is None else "solved"
    work, converged, P = found
    other = bool(np.abs(P - usual[2]).max() > 1e-6 * np.abs(usual[2]).max())
    if found is not usual and (work, converged) == usual[:2] and not other:
        return "="
    return f"{work:.0f}{'' if converged else '!'}{'~' if other else ''}"


def main(names):
    """Print a row for each value of the numbers, or of those of these `names`."""
    chosen = [each for each in numbers() if not names or {each.name, each.path.stem, each.title} & {*names}]
    if not chosen:
        sys.exit(
            f"constants.py: {' '.join(names)}: there are {', '.join(each.title for each in numbers())}"
        )
    usual = answers()
    print(f"| number | value | {' | '.join(CASES)} |\n{(2 + len(CASES)) * '| --- '}|")
    print(f"| as it is | | {' | '.join(cell(found, found) for found in usual.values())} |", flush=True)
    for number in chosen:
        for value in number.others():
            found = answers(number, value)
            cells = " | ".join(cell(found[case], usual[case]) for case in CASES)
            print(f"| {number.title} | {value:g} for {number.value:g} | {cells} |", flush=True)


if __name__ == "__main__":
    solve_all(sys.argv[2]) if sys.argv[1:2] == ["--solve"] else main(sys.argv[1:])
