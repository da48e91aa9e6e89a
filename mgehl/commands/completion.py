"""mgehl completion: print a script that completes mgehl's words in a shell

Print a completion script. In bash, for this session or from ~/.bashrc for all: eval "$(mgehl completion
bash)"

example: mgehl completion bash
"""

import argparse

from mgehl.config import KEYS

SHELLS = ("bash", "zsh", "tcsh")

SETTINGS = " ".join(KEYS)

BASH = f"""\
_mgehl_settings() {{
  compgen -S = -W "{SETTINGS}" -- "$1"
}}"""
"""Completes the key of --set KEY=VALUE."""

BASH_END = """
_mgehl() {
  _shtab_mgehl "$@"
  if [[ ${COMPREPLY[0]-} == *= ]]; then compopt -o nospace; fi
}
complete -o bashdefault -F _mgehl mgehl"""
"""Leaves the cursor behind the equals sign of a key."""

KEY = {
    "bash": "_mgehl_settings",
    "zsh": f"({SETTINGS})",
    "tcsh": f"({SETTINGS})",
    "preamble": {"bash": BASH},
}

COMPLETES = {"CONFIG": "FILE", "FILE": "FILE", "DIR": "DIR", "RUN": "DIR", "KEY=VALUE": "KEY"}
"""What completes an argument, by its metavar, in all commands."""


def add(parser):
    parser.add_argument("shell", choices=SHELLS, metavar="SHELL", help=", ".join(SHELLS))


def execute(options):
    """Print the script."""
    import shtab

    _say_what_completes(options.parser, {"FILE": shtab.FILE, "DIR": shtab.DIRECTORY, "KEY": KEY})
    print(shtab.complete(options.parser, options.shell) + (BASH_END if options.shell == "bash" else ""))


def _say_what_completes(parser, kinds):
    """Tell shtab by every argument's metavar: files, directories or keys."""
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for each in action.choices.values():
                _say_what_completes(each, kinds)
        elif action.metavar in COMPLETES:
            action.complete = kinds[COMPLETES[action.metavar]]
