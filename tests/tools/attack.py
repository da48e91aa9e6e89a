"""Attacks on the finished program, made up by chance: no traceback, no hang, nothing false, nothing lost.

    python tests/tools/attack.py words --count 1000 --seed 1
    python tests/tools/attack.py damage --count 200
    python tests/tools/attack.py flips --count 400

Each prints a line for every finding and at last the counts as JSON; exit status 1 where something was
found.
Whatever is written is in a directory of its own, which goes in the end. Words, damage and flips are tried
in forks of one process, which has everything imported: a thousand take minutes.
"""

import argparse
import json
import os
import random
import sys
import tempfile
from pathlib import Path

from attack_files import attack_damage, attack_flips
from attack_ground import Findings
from attack_words import attack_words

ATTACKS = {
    "words": attack_words, "damage": attack_damage, "flips": attack_flips,
}  # fmt: skip


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("attack", choices=ATTACKS)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=float("inf"), help="end after so long")
    options = parser.parse_args()
    findings, before = Findings(options.seconds), Path.cwd()
    with tempfile.TemporaryDirectory(prefix="attack-") as name:
        os.chdir(name)
        try:
            chance = random.Random(options.seed)
            ATTACKS[options.attack](options.count, chance, Path(name), findings)
        finally:
            os.chdir(before)
    counts = {"attack": options.attack, "seed": options.seed, "outcomes": findings.counts}
    print(json.dumps({**counts, "findings": len(findings.found)}))
    return 1 if findings.found else 0


if __name__ == "__main__":
    sys.exit(main())
