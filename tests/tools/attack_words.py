"""Command lines with malice, made up by chance."""

import shutil

from attack_ground import FOREIGN, SMALL, forked, judge, lay, untouched, warm

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
    "study": ["--nodes", "--direction", "--out", "--quiet"], "cite": [],
    "sweep": ["--set", "--over", "--out", "--resume", "--both-ways", "--quiet"],
}  # fmt: skip
PETSC = ["-mgehl_ksp_type", "-fp_trap", "-options_file", "-log_view", "-mgehl_ksp_rtol"]
FLAGS = {"--force", "--quiet", "--json-lines", "--no-error"}
SANE = ["vts,nc", "png", "lines", "status", "65", "129", "1", "2 s", "point", "line", "bash", "inlet",
        "wedge-257"]  # fmt: skip
KEPT = {"healthy", "stopped", "wedge", "good.toml", "bad.toml", "link", "pipe.npz", ".out", ".err"}


def key_word(chance):
    """A word for --set: a key with a value that is at an end of what it may be, or beyond."""
    from dataclasses import fields

    from mgehl.config import SECTIONS

    section = chance.choice(list(SECTIONS))
    key = chance.choice(fields(SECTIONS[section]))
    rules = key.metadata
    ends = [rules["low"], rules["high"], rules["above"]]
    known = [*(rules["choices"] or ()), *(end for end in ends if end is not None)]
    values = [*known, *NASTY, 1e-300, 1e300, "true"]
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
        words.append(chance.choice(PETSC))
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
        if not (folder / "healthy" / "fields.h5").exists():
            findings.say(f"healthy run lost by {words!r}")
            return
