"""The command line.

    mpiexec -n 2 python -m mgehl run [CONFIG] [--set key=value ...] [--out DIR] [PETSc options]

argparse takes the words before the first single-dash option, PETSc the others: README, "PETSc options".
"""

import argparse
import logging
import os
import re
import sys
import time
import warnings
from importlib import import_module

from mgehl.address_space import check_address_space
from mgehl.commands import COMMANDS, CONVERGED, PARALLEL, USAGE, execute_on
from mgehl.errors import UserError, one_line
from mgehl.failures import told
from mgehl.petsc_options import check_options, leave_signals_alone
from mgehl.version import VERSION

PATIENCE = 5.0
"""Seconds after which a rank with an error ends the job if the others do not join it."""

LONGEST = 300
"""Characters of what is wrong with a command line."""

QUOTED = re.compile(r"(?:[^\s']|'[^']*')+")
"""A word of a shell, with what is quoted in it."""


def main(arguments=None):
    """Run the command line; return the exit status: 0, 1, 2 or a signal's. Every error is one line."""
    _prepare()
    command = None
    try:
        os.getcwd()  # MPI says it in nineteen lines where that is gone
        own, petsc = split_options(sys.argv[1:] if arguments is None else arguments)
        command = read(own, petsc)
        check_address_space()
        is_alone = command.command not in PARALLEL and _rank() is None
        status = command.module.execute(command) if is_alone else _in_parallel(command, petsc)
    except (Exception, KeyboardInterrupt) as error:
        status = _say_before_mpi(error)
    return _flushed(status or CONVERGED, bool(command) and command.command in PARALLEL)


def _prepare():
    """Standard streams that are there and take every name; libraries whose warnings are nobody's."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:  # closed: the first file to be opened would get its number, and its words
            os.open(os.devnull, os.O_RDWR)
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))
        elif hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")
    os.environ["MPLBACKEND"] = "agg"  # pictures are files, whatever else draws in a notebook or a window
    logging.lastResort.setLevel(logging.ERROR)  # matplotlib's, of a place for its cache
    warnings.filterwarnings("ignore", category=DeprecationWarning)
    if any(action == "error" for action, *_ in warnings.filters):
        warnings.simplefilter("ignore")
    leave_signals_alone()


def _say(error):
    """Say what went wrong; return the exit status."""
    from mgehl.saying import complain

    line, status = told(error)
    if line:
        complain(line)
    return status


def _say_before_mpi(error):
    """Say what went wrong before ranks know of each other; mistakes are those of all, and one says them."""
    status = told(error)[1]
    return _say(error) if _is_first() or status != USAGE else status


def _flushed(status, is_run):
    """The exit status, when all words are out. A run does not depend on who listens."""
    from mgehl.saying import silence

    try:
        sys.stdout.flush()
    except (OSError, ValueError) as error:
        silence(sys.stdout)
        if not is_run and status == 0:
            return _say(error if isinstance(error, OSError) else OSError(str(error)))
    try:
        sys.stderr.flush()
    except (OSError, ValueError):
        silence(sys.stderr)
    return status


PETSC_OPTION = re.compile(r"-(?![-\d.])")
"""How the first of PETSc's words begins."""


class _Help(argparse.HelpFormatter):
    """Breaks lines at spaces, but in a table; those of examples so that a shell takes what is copied."""

    def _fill_text(self, text, width, indent):
        if "\n\n" in text:
            return text
        if not text.startswith("example: "):
            return super()._fill_text(text, width, indent)
        lines = [""]
        for word in QUOTED.findall(text):
            if lines[-1] and len(lines[-1]) + len(word) + 3 > width:
                lines.append(" " * len("example:"))
            lines[-1] += f" {word}" if lines[-1] else word
        return " \\\n".join(lines)


class _Parser(argparse.ArgumentParser):
    """Says in one line what is wrong."""

    def __init__(self, *arguments, **named):
        super().__init__(*arguments, **{"formatter_class": _Help} | named)

    def error(self, message):
        self.exit(USAGE, f"mgehl: {one_line(message, LONGEST)} (see {self.prog} --help)\n")

    def _print_message(self, message, file=None):
        """Help, version and mistakes: of several ranks one says them."""
        if _is_first():
            super()._print_message(message, file)


def _is_first():
    """Whether this is the rank that speaks: a mistake need not start MPI."""
    return _rank() in (None, "0")


def _rank():
    """The rank that mpiexec tells; None where none was told."""
    names = ("OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "SLURM_PROCID")
    return next((os.environ[name] for name in names if name in os.environ), None)


def parser():
    """The parser of all commands; the options it reads name their command's `module` and the `parser`."""
    top = _Parser(
        prog="mgehl", description="Multigrid for mixed and boundary lubrication of loaded contacts."
    )
    top.add_argument("--version", action="version", version=f"mgehl {VERSION}")
    commands = top.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name in COMMANDS:
        module = import_module(f"mgehl.commands.{name}")
        title, *description, example = module.__doc__.split("\n\n")
        each = commands.add_parser(
            name, help=title.removeprefix(f"mgehl {name}: "), description="\n\n".join(description),
            epilog=example.strip(), allow_abbrev=False,
        )  # fmt: skip
        if hasattr(module, "add"):
            module.add(each)
        each.set_defaults(module=module, parser=top)
    return top


def read(own, petsc=()):
    """The options that mgehl's own words give; ends with one line and status 2 where they are wrong."""
    top = parser()
    for word in petsc:
        if word.startswith("--"):
            top.error(f"{word}: PETSc options take one dash and come last")
    if not own and not petsc:
        top.print_help()
        top.exit()
    command = top.parse_args(own)
    for name, value in vars(command).items():
        _check_word(top, name, value if isinstance(value, list) else [value])
    return command


def _check_word(top, name, values):
    """A word that is nothing, or that no file can be called, is a mistake."""
    for value in values:
        if isinstance(value, str) and (not value.strip() or "\0" in value):
            word = {"settings": "set"}.get(name, name).replace("_", "-")
            top.error(f"{word} {value!r}: must be a word that stands for something")


def split_options(arguments):
    """Split the words of a command line into mgehl's own and PETSc's: a number below 0 is no option."""
    for position, word in enumerate(arguments):
        if word == "-":
            raise UserError("-: is no file; standard input is /dev/stdin")
        if PETSC_OPTION.match(word) and word != "-h":
            return arguments[:position], arguments[position:]
    return arguments, []


def _in_parallel(command, petsc):
    """Start MPI and PETSc, the arguments being good, and execute."""
    check_options(petsc)
    import petsc4py

    petsc4py.init([sys.argv[0], *petsc, *(["-options_left"] if petsc else [])])
    from mpi4py import MPI
    from petsc4py import PETSc  # noqa: F401  (wakes it)

    return _on_all_ranks(command, MPI.COMM_WORLD)


def _on_all_ranks(command, comm):
    """Execute on all ranks; where all fail they leave together, and one of them says why."""
    apart = comm.Dup()  # for errors: on `comm` the other ranks may be at something else
    try:
        return execute_on(comm, command)
    except (Exception, KeyboardInterrupt) as error:
        together = _meet(apart)
        status = _say(error) if comm.rank == 0 or not together else told(error)[1]
        if not together:  # one rank's failure must not leave the others waiting
            sys.stderr.flush()
            comm.Abort(status)
        return status


def _meet(comm):
    """Whether all ranks come here soon; they do where all have met the same error (collective)."""
    all_here, deadline = comm.Ibarrier(), time.monotonic() + PATIENCE
    while not all_here.Test():
        if time.monotonic() > deadline:
            return False
        time.sleep(0.01)
    return True
