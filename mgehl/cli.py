"""The command line.

    mpiexec -n 2 python -m mgehl run [CONFIG] [--set key=value ...] [--out DIR] [PETSc options]
    mpiexec -n 2 python -m mgehl study NAME [--nodes 129,257] [--out DIR] [PETSc options]
    python -m mgehl collect RUN [RUN ...] [--out FILE.csv]
    python -m mgehl plot RUN [RUN ...] [--kind lines,film] [--format png,svg,pdf]
    python -m mgehl report RUN
    python -m mgehl check CONFIG [--set key=value ...] [--ranks N]
    python -m mgehl new NAME [--kind point|line|wedge]
    python -m mgehl keys | info | bench | completion

`mgehl --help` lists all commands; `mgehl.commands` holds them, a module each.

argparse takes the words before the first single-dash option, PETSc that option and all after.
Options of the run's own solvers carry the prefix mgehl_ (-mgehl_ksp_monitor, -mgehl_snes_view;
mgehl_fluid_ for the fluid solved apart), global ones none (-log_view). Unused ones are reported.
"""

import argparse
import signal
import sys
import time
import traceback
from importlib import import_module

from mgehl.commands import COMMANDS, USAGE
from mgehl.errors import Stopped, UserError

PATIENCE = 5.0
"""Seconds after which a rank with an error ends the job if the others do not join it."""


def main(arguments=None):
    """Run the command line; return the exit status."""
    own, petsc = split_options(sys.argv[1:] if arguments is None else arguments)
    command = read(own, petsc)
    try:
        return _in_parallel(command, petsc) if command.module.PARALLEL else _alone(command)
    except KeyboardInterrupt:  # of a command that keeps nothing, or not yet
        print("mgehl: stopped by Ctrl-C", file=sys.stderr)
        return 128 + signal.SIGINT


class _Help(argparse.HelpFormatter):
    """Wraps everything but examples, which are to be copied."""

    def _fill_text(self, text, width, indent):
        return text if text.startswith("example: ") else super()._fill_text(text, width, indent)


class _Parser(argparse.ArgumentParser):
    """Says in one line what is wrong."""

    def __init__(self, *arguments, **named):
        super().__init__(*arguments, **{"formatter_class": _Help} | named)

    def error(self, message):
        from mpi4py import MPI

        self.exit(
            USAGE, f"mgehl: {message} (see {self.prog} --help)\n" if MPI.COMM_WORLD.rank == 0 else None
        )


def parser():
    """The parser of all commands; the options it reads name their command's `module` and the `parser`."""
    top = _Parser(
        prog="mgehl", description="Multigrid for mixed and boundary lubrication of loaded contacts."
    )
    commands = top.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name in COMMANDS:
        module = import_module(f"mgehl.commands.{name}")
        module.add(commands).set_defaults(module=module, parser=top)
    return top


def read(own, petsc=()):
    """The options that mgehl's own words give; ends with one line and status 2 where they are wrong."""
    top = parser()
    for word in petsc:
        if word.startswith("--"):
            top.error(f"{word}: PETSc options take one dash and come last")
    return top.parse_args(own)


def split_options(arguments):
    """Split the words of a command line into mgehl's own and PETSc's."""
    for position, word in enumerate(arguments):
        if word.startswith("-") and not word.startswith("--") and word != "-h":
            return arguments[:position], arguments[position:]
    return arguments, []


def _alone(command):
    """Execute a command that starts no MPI."""
    try:
        return command.module.execute(command)
    except UserError as error:
        print(f"mgehl: {error}", file=sys.stderr)
        return USAGE


def _in_parallel(command, petsc):
    """Start MPI and PETSc, the arguments being good, and execute."""
    import petsc4py

    petsc4py.init([sys.argv[0], *petsc, *(["-options_left"] if petsc else [])])
    from mpi4py import MPI
    from petsc4py import PETSc  # noqa: F401  (wakes it: it takes over the signals)

    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # a reader that has read enough, as in "| head"
    return _on_all_ranks(command, MPI.COMM_WORLD)


def _on_all_ranks(command, comm):
    """Execute on all ranks; errors of the user's making end in one line and status 2."""
    from petsc4py import PETSc

    apart = comm.Dup()  # for errors: on `comm` the other ranks may be at something else
    try:
        return command.module.execute(command, comm)
    except UserError as error:
        together = _meet(apart)
        if comm.rank == 0 or not together:
            print(f"mgehl: {error}", file=sys.stderr, flush=True)
        if not together:
            comm.Abort(USAGE)
        return USAGE
    except Stopped as stopped:
        if comm.rank == 0:
            print(f"mgehl: {stopped}", file=sys.stderr)
        return stopped.status
    except PETSc.Error as error:
        # Mostly an option that this matrix-free solver cannot serve, such as -mgehl_pc_type lu.
        print(f"mgehl: PETSc: {' '.join(str(error).split())[:200]}", file=sys.stderr, flush=True)
        comm.Abort(1)
    except Exception:
        # One rank's failure must not leave the others waiting.
        print(f"mgehl: rank {comm.rank} failed", file=sys.stderr)
        traceback.print_exc()
        sys.stderr.flush()
        comm.Abort(1)


def _meet(comm):
    """Whether all ranks come here soon; they do where all have met the same error (collective)."""
    all_here, deadline = comm.Ibarrier(), time.monotonic() + PATIENCE
    while not all_here.Test():
        if time.monotonic() > deadline:
            return False
        time.sleep(0.01)
    return True
