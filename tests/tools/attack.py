"""Command lines with malice, made up by chance: no traceback, no hang, nothing false, nothing lost.

    python tests/tools/attack.py --count 1000 --seed 1

Prints a line for every finding and at last the counts as JSON; exit status 1 where something was found.
Whatever is written is in a directory of its own, which goes in the end. Commands are tried in forks of one
process, which has everything imported: a thousand take minutes.
"""

import argparse
import json
import os
import random
import resource
import shutil
import signal
import sys
import tempfile
import time
from collections import Counter
from dataclasses import fields
from pathlib import Path

STATUSES = {0, 1, 2, 129, 130, 141, 143}
LIMIT = 60.0
"""Seconds that a command may take."""

FILE_LIMIT = 2**28
"""Bytes that a file of an attacked command may have."""

SMALL = ["--set", "grid.nodes=65", "--set", "solver.start=contact", "--quiet"]
FOREIGN = {
    "foreign/notes.txt": "mine",
    "foreign/result.json": "mine",
    "foreign/checkpoint/under-way.npz": "mine",
    "foreign/fields.h5": "mine",
    "precious.txt": "mine",
}
IMPORTED = ["matplotlib.figure", "matplotlib.style", "h5netcdf", "pint", "jinja2", "dacite", "numba",
            "pyfftw", "scipy.interpolate"]  # fmt: skip

NASTY = ["", " ", "-", "--", ".", "..", "/", "//", "a\x00b", "\x1b[2J", "x" * 5000, "\udcff\udcfe", "nan",
         "-1", "1e400", "0x10", "{}", "[]", "'", '"', "\n", "/dev/null", "/dev/full", "/dev/zero",
         "/proc/self/mem", "~", "$HOME", "%s", "*", "é", "\u202e", "link", "foreign", "precious.txt",
         "healthy", "stopped", "wedge", "good.toml", "bad.toml", "nowhere", "healthy/result.json",
         "pipe.npz"]  # fmt: skip
OPTIONS = {
    "run": ["--set", "--out", "--resume", "--start-from", "--save-every", "--time-limit", "--force",
            "--quiet", "--json-lines", "--no-error"],
    "check": ["--set", "--ranks"], "collect": ["--out", "--columns"],
    "plot": ["--kind", "--out", "--format", "--style", "--dpi"], "report": ["--out", "--force"],
    "export": ["--to", "--out", "--force"], "new": ["--kind", "--force"], "keys": [], "info": ["--json"],
    "completion": [], "bench": ["--case", "--repeat", "--compare"],
    "study": ["--nodes", "--direction", "--mean", "--out", "--quiet"],
}  # fmt: skip
FLAGS = {"--force", "--quiet", "--json-lines", "--no-error"}
SANE = ["vts,nc", "png", "lines", "status", "65", "129", "1", "2 s", "point", "line", "bash", "inlet",
        "wedge-257"]  # fmt: skip
KEPT = {"healthy", "stopped", "wedge", "good.toml", "bad.toml", "link", "pipe.npz", ".out", ".err"}


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
            resource.setrlimit(resource.RLIMIT_FSIZE, (FILE_LIMIT, FILE_LIMIT))
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
    for name in IMPORTED:
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


def key_word(chance):
    """A word for --set: a key with a value that is at an end of what it may be, or beyond."""
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


def attack(count, chance, folder, findings):
    """Try so many command lines with malice."""
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
        if not (folder / "healthy" / "fields.h5").exists():
            findings.say(f"healthy run lost by {words!r}")
            return


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=float("inf"), help="end after so long")
    options = parser.parse_args()
    findings, before = Findings(options.seconds), Path.cwd()
    with tempfile.TemporaryDirectory(prefix="attack-") as name:
        os.chdir(name)
        try:
            attack(options.count, random.Random(options.seed), Path(name), findings)
        finally:
            os.chdir(before)
    counts = {"seed": options.seed, "outcomes": findings.counts, "findings": len(findings.found)}
    print(json.dumps(counts))
    return 1 if findings.found else 0


if __name__ == "__main__":
    sys.exit(main())
