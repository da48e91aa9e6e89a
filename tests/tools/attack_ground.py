"""The ground of the attacks: findings, commands, and a folder with runs and files of others."""

import os
import resource
import signal
import sys
import time
from collections import Counter

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
        _put(folder / name, text)
    (folder / "good.toml").write_text("[grid]\nnodes = 65\n[solver]\nstart = 'contact'\n")
    (folder / "bad.toml").write_bytes(b"[grid\n\x00\xff")
    (folder / "link").symlink_to("foreign")
    os.mkfifo(folder / "pipe.npz")
    forked(["run", *SMALL, "--out", "healthy"], folder)
    forked(["run", *SMALL, "--out", "stopped", "--time-limit", "1e-9"], folder)
    wedge = ["--set", "contact.kind=wedge", "--set", "grid.nodes=65", "--quiet"]
    forked(["run", *wedge, "--out", "wedge"], folder)


def untouched(findings, folder, words):
    for name, text in FOREIGN.items():
        if not (folder / name).exists() or (folder / name).read_text() != text:
            findings.say(f"foreign file {name} touched by {words!r}")
            _put(folder / name, text)


def _put(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
