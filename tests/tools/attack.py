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
forks of one process, which has everything imported: a thousand take minutes. With --fresh each command line is
a process of its own, from the first import on.
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

from attack_cases import attack_cases

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


def alone(words, folder):
    """(status, stdout, stderr) of a command line in a process of its own; None for a hang."""
    process = command(words, limit=2**28)
    try:
        _, err = process.communicate(timeout=LIMIT)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        return None, "", ""
    return process.returncode, "", err


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


def attack_words(count, chance, folder, findings, fresh=False):
    """Command lines with malice."""
    warm()
    lay(folder)
    for _ in findings.rounds(count):
        words = line_of(chance)
        is_alone = fresh and "\0" not in "".join(words)  # no process can be started with that
        status, _, err = (alone if is_alone else forked)(words, folder)
        judge(findings, words, status, err)
        untouched(findings, folder, words)
        for path in folder.iterdir():  # what a command made of nasty words
            if path.name not in KEPT and path.name not in {name.split("/")[0] for name in FOREIGN}:
                shutil.rmtree(path) if path.is_dir() and not path.is_symlink() else path.unlink()
        if not (folder / "healthy" / "manifest.json").exists():
            findings.say(f"healthy run lost by {words!r}")
            return


KEPT = {"healthy", "stopped", "wedge", "good.toml", "bad.toml", "link", "pipe.npz", ".out", ".err"}


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


def cases(count, chance, _folder, findings):
    """Extreme configurations, in this process."""
    attack_cases(count, chance, findings, int(LIMIT))


def command(words, ranks=1, limit=None):
    """A process of mgehl of its own, or a job of several; `limit` is that of a file's bytes."""
    environment = {k: v for k, v in os.environ.items() if not k.startswith(("OMPI_COMM", "PMIX_", "PRTE_"))}
    words = [sys.executable, "-m", "mgehl", *words]
    words = ["mpiexec", "-n", str(ranks), *words] if ranks > 1 else words
    words = ["bash", "-c", f'ulimit -f {limit // 1024}; exec "$@"', "-", *words] if limit else words
    return subprocess.Popen(
        words,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        errors="replace",
        env=environment,
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


def wait_for_a_moment(chance, process, checkpoint, usual):
    """Any moment of a run that usually takes so long; most of it is imports, so mostly one after these."""
    started = time.monotonic()
    if chance.random() < 0.25:
        time.sleep(chance.uniform(0.1, 1.1) * usual)
        return
    before = checkpoint.stat().st_mtime_ns if checkpoint.exists() else None
    while process.poll() is None and time.monotonic() - started < LIMIT:
        if checkpoint.exists() and checkpoint.stat().st_mtime_ns != before:
            break
        time.sleep(0.001)
    time.sleep(chance.uniform(0.0, 0.3) * usual)


def attack_kills(count, chance, folder, findings, ranks=1):
    """SIGKILL at any moment, with --resume or --force after it; the end is the same."""
    from mgehl.output.stored import read_run

    words = ["run", "--set", "grid.nodes=65", "--set", "solver.start=film", "--no-error", "--quiet", "--out", "here",
             "--save-every", "0.001", "--set", "motion.speed=0.5"]  # fmt: skip
    killed, begun_killed = 0, 0
    started = time.monotonic()
    status = command([*words, "--out", "whole"], ranks).wait()
    usual = time.monotonic() - started
    if status:
        findings.say(f"the run without a kill: {status}")
    while killed < count:
        begun = any((folder / "here" / name / "manifest.json").exists() for name in (".", "checkpoint"))
        process = command(["run", "--resume", "here", "--quiet"] if begun else [*words, "--force"], ranks)
        wait_for_a_moment(chance, process, folder / "here" / "checkpoint", usual)
        begun = begun or (folder / "here" / "checkpoint" / "manifest.json").exists()
        process.kill()
        _, err = process.communicate(timeout=LIMIT)
        killed += process.returncode == -signal.SIGKILL
        begun_killed += begun and process.returncode == -signal.SIGKILL
        findings.tried(process.returncode)
        if process.returncode == 0:
            if abs(read_run(folder / "here").result.central_film_nm / films()[0.5] - 1.0) > 1e-9:
                findings.say("another film after kills")
            shutil.rmtree(folder / "here")
        elif process.returncode != -signal.SIGKILL:
            findings.say(f"{process.returncode}: {err}")
            shutil.rmtree(folder / "here", ignore_errors=True)
        time.sleep(0.3 if ranks > 1 else 0.0)
    findings.counts["kills after it had begun"] = begun_killed
    begun = (folder / "here" / "checkpoint" / "manifest.json").exists()
    process = command(["run", "--resume", "here", "--quiet"] if begun else [*words, "--force"])
    _, err = process.communicate(timeout=LIMIT)
    if (
        process.returncode
        or abs(read_run(folder / "here").result.central_film_nm / films()[0.5] - 1.0) > 1e-9
    ):
        findings.say(f"the end after kills: {process.returncode} {err}")


ATTACKS = {
    "words": attack_words, "cases": cases, "damage": attack_damage, "flips": attack_flips,
    "writers": attack_writers, "kills": attack_kills,
}  # fmt: skip


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("attack", choices=ATTACKS)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--fresh", action="store_true", help="each command line is a process of its own")
    parser.add_argument("--seconds", type=float, default=float("inf"), help="end after so long")
    options = parser.parse_args()
    findings, before = Findings(options.seconds), Path.cwd()
    with tempfile.TemporaryDirectory(prefix="attack-") as name:
        os.chdir(name)
        try:
            more = {"kills": {"ranks": options.ranks}, "words": {"fresh": options.fresh}}.get(
                options.attack, {}
            )
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
