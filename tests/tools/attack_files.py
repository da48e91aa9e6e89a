"""Run directories that something damaged: each is read as what it was, or not at all."""

import json
import os
import shutil

import numpy as np
from attack_ground import SMALL, forked, judge, lay, untouched, warm

READERS = [
    ["report", "victim"],
    ["plot", "victim", "--kind", "lines", "--format", "png"],
    ["collect", "victim"],
    ["export", "victim", "--to", "npz", "--force"],
    ["run", "--resume", "victim", "--quiet"],
    ["run", *SMALL, "--start-from", "victim", "--out", "after", "--force"],
]
DAMAGES = ["missing", "cut", "empty", "swapped", "edited", "link", "pipe", "folder", "zero"]


def attack_damage(count, chance, folder, findings):
    """Run directories with files missing, cut, swapped, edited, linked or made devices."""
    known = _ground(folder)
    for _ in findings.rounds(count):
        victim = _copied(folder, chance.choice(["healthy", "healthy", "stopped"]))
        files = [path for path in victim.rglob("*") if path.is_file() and path.name != "picture.png"]
        path = chance.choice(files)
        how = chance.choice(DAMAGES)
        _damage(path, how, chance, folder)
        _attack([how, path.name], chance, folder, findings, known)


def attack_flips(count, chance, folder, findings):
    """One bit of one file of a finished run."""
    known = _ground(folder)
    for _ in findings.rounds(count):
        victim = _copied(folder, "healthy")
        path = chance.choice([each for each in victim.iterdir() if each.name != "picture.png"])
        whole = bytearray(path.read_bytes())
        position = chance.randrange(len(whole))
        whole[position] ^= 1 << chance.randrange(8)
        path.write_bytes(whole)
        _attack(["flip", path.name, position], chance, folder, findings, known)


def _ground(folder):
    """Lay it; return the answers that there are: of two runs."""
    warm()
    lay(folder)
    forked(["run", *SMALL, "--set", "motion.speed=1e-4", "--out", "other"], folder)
    return [_answer(folder, name) for name in ("healthy", "other")]


def _attack(damage, chance, folder, findings, known):
    """Let somebody read the victim: in one line it is refused, or it is one of the `known` answers."""
    words = chance.choice(READERS)
    status, _, err = forked(words, folder)
    judge(findings, [*damage, *words], status, err)
    if status == 0 and _answer(folder, "victim") not in known:
        findings.say(f"another answer: {damage}, {words!r}")
    untouched(findings, folder, words)


def _answer(folder, name):
    """All that is read of a run but its times, as bytes."""
    forked(["export", name, "--to", "npz", "--force", "--out", "answer.npz"], folder)
    with np.load(folder / "answer.npz") as file:
        fields = [file[each].tobytes() for each in ("x", "pressure", "film", "P", "H", "status")]
        result, configuration = (json.loads(str(file[each])) for each in ("result", "configuration"))
    (folder / "answer.npz").unlink()
    return fields, {key: each for key, each in result.items() if key != "wall_s"}, configuration


def _copied(folder, name):
    """A copy of a run, in the place of the copy before and of what was made of that."""
    victim = folder / "victim"
    for each in (victim, folder / "after"):
        shutil.rmtree(each, ignore_errors=True)
    return shutil.copytree(folder / name, victim)


def _damage(path, how, chance, folder):
    """Do one of DAMAGES to a file."""
    whole, other = path.read_bytes(), folder / "other" / path.name
    path.unlink()
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
