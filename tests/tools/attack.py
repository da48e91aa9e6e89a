# ruff: noqa: E501
"""Attacks on the finished program, made up by chance: no traceback, no hang, nothing false, nothing lost.

    python tests/tools/attack.py words --count 1000 --seed 1
    python tests/tools/attack.py cases --count 1000
    python tests/tools/attack.py damage --count 200
    python tests/tools/attack.py flips --count 400
    python tests/tools/attack.py writers --count 50
    python tests/tools/attack.py kills --count 20 --ranks 2

Each prints a line for every finding and at last the counts as JSON; exit status 1 where there was a finding.
Whatever is written is in a directory of its own, which goes in the end. Words, damage and flips are tried in
forks of one process, which has everything imported: a thousand take minutes.
"""

import argparse
import json
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import numpy as np

STATUSES = {0, 1, 2, 129, 130, 141, 143}
LIMIT = 60.0
"""Seconds that a command may take."""

SMALL = ["--set", "grid.nodes=65", "--set", "solver.start=contact", "--quiet"]
FOREIGN = {"foreign/notes.txt": "mine", "foreign/result.json": "mine", "foreign/checkpoint/under-way.npz": "mine",
           "foreign/fields.h5": "mine", "precious.txt": "mine"}  # fmt: skip


class Findings:
    """Counts what was tried, and names what was found."""

    def __init__(self, seconds=float("inf")):
        self.counts, self.found = Counter(), []
        self._deadline = time.monotonic() + seconds

    def rounds(self, count):
        """Numbers from 0, as many as `count`, or fewer where the time is over."""
        for number in range(count):
            if time.monotonic() > self._deadline:
                return
            yield number

    def tried(self, outcome):
        self.counts[str(outcome)] += 1

    def say(self, what):
        self.found.append(what)
        print("FOUND", what, flush=True)


def forked(words, folder):
    """(status, stdout, stderr) of a command line in a fork of this process; None for a hang."""
    out, err = folder / ".out", folder / ".err"
    child = os.fork()
    if child == 0:
        status = 70
        try:
            for number, path in ((1, out), (2, err)):
                file = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
                os.dup2(file, number)
            sys.stdout, sys.stderr = (os.fdopen(n, "w", closefd=False) for n in (1, 2))
            resource.setrlimit(resource.RLIMIT_FSIZE, (2**28, 2**28))
            from mgehl.cli import main

            try:
                status = main(words)
            except SystemExit as stop:
                status = stop.code or 0
            sys.stdout.flush()
            sys.stderr.flush()
        except BaseException as error:  # what is not caught below is a finding
            os.write(2, f"Traceback: {error!r}".encode())
        os._exit(status)
    deadline = time.monotonic() + LIMIT
    while time.monotonic() < deadline:
        done, code = os.waitpid(child, os.WNOHANG)
        if done:
            said = [path.read_text(errors="replace") if path.exists() else "" for path in (out, err)]
            return os.waitstatus_to_exitcode(code), *said
        time.sleep(0.002)
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return None, "", ""


def judge(findings, words, status, err):
    """A finding where a command hung, spoke at length or ended in another way than it may."""
    findings.tried(status)
    lines = [line for line in err.splitlines() if line.strip() and not line.startswith("[")]
    if status is None:
        findings.say(f"hang: {words!r}")
    elif status not in STATUSES:
        findings.say(f"status {status}: {words!r}: {err[-300:]!r}")
    elif "Traceback" in err or "an error of mgehl's own" in err or "PETSC ERROR" in err:
        findings.say(f"traceback: {words!r}: {err[-400:]!r}")
    elif status == 2 and len(lines) != 1:
        findings.say(f"{len(lines)} lines: {words!r}: {err[-300:]!r}")
    elif any(not each.isprintable() for line in lines for each in line):
        findings.say(f"control characters: {words!r}")


def warm():
    """Import what forks would import again and again; without MPI, which is no thing to fork."""
    for name in (
        "matplotlib.figure",
        "matplotlib.style",
        "h5netcdf",
        "pint",
        "jinja2",
        "dacite",
        "numba",
        "pyfftw",
        "scipy.interpolate",
    ):
        __import__(name)


def lay(folder):
    """Foreign files, a healthy run, one that was stopped, and configurations good and bad."""
    for name, text in FOREIGN.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    (folder / "good.toml").write_text("[grid]\nnodes = 65\n[solver]\nstart = 'contact'\n")
    (folder / "bad.toml").write_bytes(b"[grid\n\x00\xff")
    (folder / "link").symlink_to("foreign")
    os.mkfifo(folder / "pipe.npz")
    forked(["run", *SMALL, "--out", "healthy"], folder)
    forked(["run", *SMALL, "--out", "stopped", "--time-limit", "1e-9"], folder)
    forked(
        ["run", "--set", "contact.kind=wedge", "--set", "grid.nodes=65", "--quiet", "--out", "wedge"],
        folder,
    )


def untouched(findings, folder, words):
    for name, text in FOREIGN.items():
        if not (folder / name).exists() or (folder / name).read_text() != text:
            findings.say(f"foreign file {name} touched by {words!r}")
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(text)


NASTY = ["", " ", "-", "--", ".", "..", "/", "//", "a\x00b", "\x1b[2J", "x" * 5000, "\udcff\udcfe", "nan", "-1",
         "1e400", "0x10", "{}", "[]", "'", '"', "\n", "/dev/null", "/dev/full", "/dev/zero", "/proc/self/mem",
         "~", "$HOME", "%s", "*", "é", "\u202e", "link", "foreign", "precious.txt", "healthy", "stopped",
         "wedge", "good.toml", "bad.toml", "nowhere", "healthy/result.json", "pipe.npz"]  # fmt: skip
OPTIONS = {
    "run": ["--set", "--out", "--resume", "--start-from", "--save-every", "--time-limit", "--force", "--quiet",
            "--json-lines", "--no-error"],
    "check": ["--set", "--ranks"], "collect": ["--out", "--columns"],
    "plot": ["--kind", "--out", "--format", "--style", "--dpi"], "report": ["--out", "--force"],
    "export": ["--to", "--out", "--force"], "new": ["--kind", "--force"], "keys": [], "info": ["--json"],
    "completion": [], "bench": ["--case", "--repeat", "--compare"],
    "study": ["--nodes", "--direction", "--mean", "--out", "--quiet"],
}  # fmt: skip
FLAGS = {"--force", "--quiet", "--json-lines", "--no-error"}
SANE = [
    "vts,nc",
    "png",
    "lines",
    "status",
    "65",
    "129",
    "1",
    "2 s",
    "point",
    "line",
    "bash",
    "inlet",
    "wedge-257",
]


def key_word(chance):
    """A word for --set: a key with a value that is at an end of what it may be, or beyond."""
    from dataclasses import fields

    from mgehl.config import SECTIONS

    section = chance.choice(list(SECTIONS))
    key = chance.choice(fields(SECTIONS[section]))
    rules = key.metadata
    ends = [rules["low"], rules["high"], rules["above"]]
    values = [
        *(rules["choices"] or ()),
        *(end for end in ends if end is not None),
        *NASTY,
        1e-300,
        1e300,
        "true",
    ]
    if f"{section}.{key.name}" == "grid.nodes":
        values = [33, 65, 66, -1, "a"]  # a large grid is no attack
    return f"{section}.{key.name}={chance.choice(values)}"


def line_of(chance):
    """A command line that is nearly right."""
    command = chance.choice([*OPTIONS, "run", "run", "report", "export", "plot", "frob", ""])
    words = [command]
    for _ in range(chance.randint(0, 3)):
        words.append(chance.choice([*NASTY, *SANE, "healthy", "wedge", "good.toml"]))
    for _ in range(chance.randint(0, 3)):
        option = chance.choice(OPTIONS.get(command) or ["--help"])
        words.append(option)
        if option == "--set":
            words.append(key_word(chance))
        elif option not in FLAGS:
            words.append(chance.choice([*NASTY, *SANE]))
    if command == "run":
        words += SMALL
    if command == "study" and "--nodes" not in words:
        words += ["--nodes", "66"]
    if command == "bench":
        words += ["--case", "nothing"]
    if chance.random() < 0.1:
        words += [
            chance.choice(["-mgehl_ksp_type", "-fp_trap", "-options_file", "-log_view", "-mgehl_ksp_rtol"])
        ]
        words += [chance.choice([*NASTY, "gmres"])]
    return words


def attack_words(count, chance, folder, findings):
    """Command lines with malice."""
    warm()
    lay(folder)
    for _ in findings.rounds(count):
        words = line_of(chance)
        status, _, err = forked(words, folder)
        judge(findings, words, status, err)
        untouched(findings, folder, words)
        for path in folder.iterdir():  # what a command made of nasty words
            if path.name not in KEPT and path.name not in {name.split("/")[0] for name in FOREIGN}:
                shutil.rmtree(path) if path.is_dir() and not path.is_symlink() else path.unlink()
        if not (folder / "healthy" / "manifest.json").exists():
            findings.say(f"healthy run lost by {words!r}")
            return


KEPT = {"healthy", "stopped", "wedge", "good.toml", "bad.toml", "link", "pipe.npz", ".out", ".err"}


def extreme(chance):
    """Tables of a configuration whose numbers are anywhere in their ranges, and beyond what is sensible."""

    def anywhere(low, high):
        return float(f"{10 ** chance.uniform(np.log10(low), np.log10(high)):.4g}")

    def ends():
        near = chance.choice([1.01, 1.05, 1.3, 2.0, 10.0, 60.0])
        far = chance.choice([1.01, 1.05, 1.3, 2.0, 10.0, 60.0])
        return chance.choice(["auto", [-near, far]])

    kind = chance.choice(["point", "point", "point", "line"])
    contact = {"kind": kind, "radius_x": anywhere(1e-4, 1.0), "reduced_modulus": anywhere(1e8, 1e12)}
    grid = {"nodes": 65, "x": ends()}
    if kind == "point":
        contact |= {"load": anywhere(1e-3, 1e5), "radius_y": contact["radius_x"] * anywhere(0.05, 20.0)}
        grid["y"] = ends()
    else:
        contact["load_per_length"] = anywhere(1e2, 1e7)
    discretization = {"contact_model": chance.choice(["lcic", "lcic", "lcic", "unified"])}
    if chance.random() < 0.5:
        discretization["face_mobility"] = chance.choice(
            ["arithmetic", "logarithmic", "linear-gap", "geometric"]
        )
    if chance.random() < 0.2:
        discretization["cavitation"] = False
    return {
        "contact": contact,
        "lubricant": {"viscosity": anywhere(1e-4, 1e2), "pressure_viscosity": anywhere(1e-10, 1e-7)},
        "motion": {"speed": anywhere(1e-9, 1e2)}
        | ({"angle": chance.uniform(0, 360)} if kind == "point" else {}),
        "grid": grid,
        "discretization": discretization,
        "solver": {"start": chance.choice(["film", "contact"]), "error": False, "max_steps": 20},
    }


def independent(solution):
    """What is wrong with a solution that says "converged", from its fields alone."""
    from mgehl.discretization.status import CONTACT
    from mgehl.model.deformation import HalfPlane, HalfSpace  # noqa: F401  (what the deflection is of)

    fields, mesh, contact = solution.fields, solution.mesh, solution.contact
    P, H, status = fields.P, fields.H, fields.status
    if not (np.isfinite(P).all() and np.isfinite(H).all()):
        return "not finite"
    tolerance = 1e-6
    gap = direct_gap(solution, chosen := np.random.default_rng(1).integers(0, P.size, 12))
    scale = max(1.0, float(np.abs(H).max()))
    if np.abs(gap - H.ravel()[chosen]).max() > 1e-7 * scale:
        return f"gap off by {np.abs(gap - H.ravel()[chosen]).max():.1e}"
    load = mesh.dX * mesh.dY * P.sum()
    if abs(load / contact.load_integral - 1.0) > 1e-6:
        return f"load off by {load / contact.load_integral - 1.0:.1e}"
    has_contact = solution.config.discretization.contact_model != "unified"
    cavitates = solution.config.discretization.cavitation is not False
    if (
        cavitates
        and P.min() < -tolerance
        or (status == CONTACT).any()
        and P[status == CONTACT].min() < -tolerance
    ):
        return f"tension {P.min():.1e}"
    if has_contact and H.min() < -tolerance:
        return f"overlap {H.min():.1e}"
    if (status == CONTACT).any() and np.abs(H[status == CONTACT]).max() > tolerance:
        return f"contact with a gap of {np.abs(H[status == CONTACT]).max():.1e}"
    ring = np.r_[P[0], P[-1], P[:, 0], P[:, -1]] if not mesh.is_line else P[0, [0, -1]]
    beside = P[0, [1, -2]] if mesh.is_line else np.r_[P[1], P[-2], P[:, 1], P[:, -2]]
    edge = H[0, [0, -1]] if mesh.is_line else np.r_[H[0], H[-1], H[:, 0], H[:, -1]]
    if np.abs(ring).max() > 0.0 or beside.max() > 0.0101 * P.max() or edge.min() < 0.0:
        return f"cut by the domain: {beside.max() / P.max():.2g} of the pressure, gap {edge.min():.2g}"
    loaded = 0.1 * P.max() <= P
    if loaded.any(axis=0).sum() < 4 or (not mesh.is_line and loaded.any(axis=1).sum() < 4):
        return "too few nodes"
    return ""


def direct_gap(solution, nodes):
    """The gap at some nodes, summed over all others without a Fourier transform."""
    from mgehl.discretization.influence import influence_coefficients

    mesh, contact, P = solution.mesh, solution.contact, solution.fields.P
    K = influence_coefficients(mesh, contact.kernel, 0, mesh.ny)
    rows, columns = np.indices(P.shape)
    found = []
    for node in nodes:
        j, i = divmod(int(node), mesh.nx)
        deflection = (K[np.abs(rows - j), np.abs(columns - i)] * P).sum()
        found.append(deflection + contact.undeformed_gap(mesh.X[i], mesh.Y[j]) + solution.H0)
    return np.array(found)


def attack_cases(count, chance, folder, findings):
    """Extreme configurations; a verdict "converged" must stand an independent test."""
    import mgehl
    from mgehl.config import config_from_tables

    def alarm(*_):
        raise TimeoutError

    signal.signal(signal.SIGALRM, alarm)
    for _ in findings.rounds(count):
        tables = extreme(chance)
        signal.alarm(int(LIMIT))
        try:
            solution = mgehl.solve(config_from_tables(tables))
            wrong = independent(solution) if solution.result.converged else ""
            findings.tried("converged" if solution.result.converged else "settled" if solution.result.settled
                           else "not converged")  # fmt: skip
            if wrong:
                findings.say(f"false: {wrong}: {json.dumps(tables)}")
        except mgehl.UserError as error:
            findings.tried("refused")
            if "\n" in str(error):
                findings.say(f"lines: {error}: {json.dumps(tables)}")
        except TimeoutError:
            findings.tried("more than a minute")
        except Exception as error:
            findings.say(f"{type(error).__name__}: {error}: {json.dumps(tables)}")
        finally:
            signal.alarm(0)


READERS = [["report", "victim"], ["plot", "victim", "--kind", "lines", "--format", "png"], ["collect", "victim"],
           ["export", "victim", "--to", "npz", "--force"], ["run", "--resume", "victim", "--quiet"],
           ["run", *SMALL, "--start-from", "victim", "--out", "after", "--force"]]  # fmt: skip


def attack_damage(count, chance, folder, findings):
    """Run directories with files missing, cut, swapped, edited, linked or made devices."""
    warm()
    lay(folder)
    forked(["run", *SMALL, "--set", "motion.speed=1e-4", "--out", "other"], folder)
    for _ in findings.rounds(count):
        victim, after = folder / "victim", folder / "after"
        for each in (victim, after):
            shutil.rmtree(each, ignore_errors=True)
        shutil.copytree(folder / chance.choice(["healthy", "healthy", "stopped"]), victim)
        files = [path for path in victim.rglob("*") if path.is_file() and path.name != "picture.png"]
        path = chance.choice(files)
        how = chance.choice(
            ["missing", "cut", "empty", "swapped", "edited", "link", "pipe", "folder", "zero"]
        )
        whole = path.read_bytes()
        path.unlink()
        other = folder / "other" / path.name
        if how == "cut":
            path.write_bytes(whole[: chance.randrange(len(whole))])
        elif how == "empty":
            path.touch()
        elif how == "swapped":
            path.write_bytes(other.read_bytes() if other.exists() else b"{}")
        elif how == "edited":
            path.write_bytes(whole.replace(b"1", b"2"))
        elif how == "link":
            path.symlink_to(folder / "precious.txt")
        elif how == "pipe":
            os.mkfifo(path)
        elif how == "folder":
            path.mkdir()
        elif how == "zero":
            path.symlink_to("/dev/zero")
        words = chance.choice(READERS)
        status, _, err = forked(words, folder)
        judge(findings, [how, path.name, *words], status, err)
        # A checkpoint may be missing: then the run begins earlier. Nothing else may pass.
        if status == 0 and not (path.suffix == ".npz" and how == "missing"):
            findings.say(f"read all the same: {how} {path.name}, {words!r}")
        untouched(findings, folder, words)


def attack_flips(count, chance, folder, findings):
    """One bit of one file of a finished run."""
    warm()
    lay(folder)
    for _ in findings.rounds(count):
        victim, after = folder / "victim", folder / "after"
        for each in (victim, after):
            shutil.rmtree(each, ignore_errors=True)
        shutil.copytree(folder / "healthy", victim)
        path = chance.choice([each for each in victim.iterdir() if each.name != "picture.png"])
        whole, position = bytearray(path.read_bytes()), 0
        position = chance.randrange(len(whole))
        whole[position] ^= 1 << chance.randrange(8)
        path.write_bytes(whole)
        words = chance.choice(READERS)
        status, _, err = forked(words, folder)
        judge(findings, ["flip", path.name, position, *words], status, err)
        if status == 0:
            findings.say(f"read all the same: bit of byte {position} of {path.name}, {words!r}")


def command(words, ranks=1):
    """A process of mgehl of its own, or a job of several."""
    environment = {k: v for k, v in os.environ.items() if not k.startswith(("OMPI_COMM", "PMIX_", "PRTE_"))}
    words = [sys.executable, "-m", "mgehl", *words]
    words = ["mpiexec", "-n", str(ranks), *words] if ranks > 1 else words
    return subprocess.Popen(
        words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env=environment
    )


def attack_writers(count, chance, folder, findings):
    """Two runs of other speeds in one directory; what is there in the end is one of them, whole."""
    from mgehl.output.stored import read_run

    for number in findings.rounds(count):
        out = f"both{number}"
        words = [
            "run",
            "--set",
            "grid.nodes=65",
            "--set",
            "solver.start=film",
            "--no-error",
            "--quiet",
            "--out",
            out,
        ]
        first = command([*words, "--set", "motion.speed=0.5"])
        time.sleep(chance.uniform(0.0, 2.5))
        second = command([*words, "--force", "--set", "motion.speed=0.7"])
        ends = []
        for process in (first, second):
            _, err = process.communicate(timeout=LIMIT)
            ends.append(process.returncode)
            judge(findings, [out], process.returncode, err)
        if 0 not in ends:
            findings.say(f"neither wrote: {ends}")
            continue
        solution = read_run(folder / out)
        known = films()[solution.config.motion.speed]
        if abs(solution.result.central_film_nm / known - 1.0) > 1e-6:
            findings.say(f"false result in {out}: {solution.result.central_film_nm} for {known}")


def films(known={}):  # noqa: B006  (solved once)
    """{speed: central film} of both."""
    import mgehl

    for speed in () if known else (0.5, 0.7):
        settings = {"grid.nodes": 65, "solver.start": "film", "solver.error": False, "motion.speed": speed}
        known[speed] = mgehl.solve(mgehl.load(None, settings)).result.central_film_nm
    return known


def attack_kills(count, chance, folder, findings, ranks=1):
    """SIGKILL at any moment, with --resume or --force after it; the end is the same."""
    from mgehl.output.stored import read_run

    words = ["run", "--set", "grid.nodes=65", "--set", "solver.start=film", "--no-error", "--quiet", "--out", "here",
             "--save-every", "0.001", "--set", "motion.speed=0.5"]  # fmt: skip
    killed = 0
    while killed < count:
        begun = any((folder / "here" / name / "manifest.json").exists() for name in (".", "checkpoint"))
        process = command(["run", "--resume", "here", "--quiet"] if begun else [*words, "--force"], ranks)
        time.sleep(chance.uniform(0.5, 3.5))
        process.kill()
        _, err = process.communicate(timeout=LIMIT)
        killed += process.returncode == -signal.SIGKILL
        findings.tried(process.returncode)
        if process.returncode == 0:
            if abs(read_run(folder / "here").result.central_film_nm / films()[0.5] - 1.0) > 1e-9:
                findings.say("another film after kills")
            shutil.rmtree(folder / "here")
        elif process.returncode != -signal.SIGKILL:
            findings.say(f"{process.returncode}: {err}")
            shutil.rmtree(folder / "here", ignore_errors=True)
        time.sleep(0.3 if ranks > 1 else 0.0)
    begun = (folder / "here" / "checkpoint" / "manifest.json").exists()
    process = command(["run", "--resume", "here", "--quiet"] if begun else [*words, "--force"])
    _, err = process.communicate(timeout=LIMIT)
    if (
        process.returncode
        or abs(read_run(folder / "here").result.central_film_nm / films()[0.5] - 1.0) > 1e-9
    ):
        findings.say(f"the end after kills: {process.returncode} {err}")


ATTACKS = {
    "words": attack_words, "cases": attack_cases, "damage": attack_damage, "flips": attack_flips,
    "writers": attack_writers, "kills": attack_kills,
}  # fmt: skip


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("attack", choices=ATTACKS)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=float("inf"), help="end after so long")
    options = parser.parse_args()
    findings, before = Findings(options.seconds), Path.cwd()
    with tempfile.TemporaryDirectory(prefix="attack-") as name:
        os.chdir(name)
        try:
            more = {"ranks": options.ranks} if options.attack == "kills" else {}
            ATTACKS[options.attack](
                options.count, random.Random(options.seed), Path(name), findings, **more
            )
        finally:
            os.chdir(before)
    print(json.dumps({"attack": options.attack, "seed": options.seed, "outcomes": findings.counts,
                      "findings": len(findings.found)}))  # fmt: skip
    return 1 if findings.found else 0


if __name__ == "__main__":
    sys.exit(main())
