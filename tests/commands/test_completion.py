import shutil
import subprocess

import pytest

from mgehl.cli import main
from mgehl.commands import COMMANDS
from mgehl.commands.completion import SHELLS

COMPLETE = """\
source ./mgehl.bash
COMP_WORDS=("$@")
COMP_CWORD=$(( $# - 1 ))
compopt() { asked="$*"; }
_mgehl
printf '%s\\n' "${COMPREPLY[@]}" $asked
"""

FILENAMES = ("-o", "filenames")
"""What completions of files ask bash for."""


@pytest.fixture
def script(capsys):
    def write(shell):
        assert main(["completion", shell]) == 0
        return capsys.readouterr().out

    return write


@pytest.fixture
def completions(script, tmp_path):
    """Function that completes the last of some words as bash would, in a directory with two entries."""
    (tmp_path / "mgehl.bash").write_text(script("bash"))
    (tmp_path / "mine.toml").touch()
    (tmp_path / "runs").mkdir()

    def complete(*words):
        command = ["bash", "-c", COMPLETE, "bash", *words]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True, timeout=30)
        return set(done.stdout.split())

    return complete


def test_commands(completions):
    assert completions("mgehl", "") == set(COMMANDS)


def test_keys_of_settings_with_their_equals_sign(completions):
    keys = {f"motion.{key}=" for key in ("speed", "angle", "slide_to_roll", "ring_rotation")}
    assert completions("mgehl", "run", "--set", "motion.") == {*keys, "-o", "nospace"}
    assert "grid.nodes=" in completions("mgehl", "run", "mine.toml", "--set", "grid.")


def test_files_directories_and_choices(completions):
    assert completions("mgehl", "run", "mi") == {"mine.toml", *FILENAMES}
    assert completions("mgehl", "collect", "") == {"runs", *FILENAMES}
    assert completions("mgehl", "run", "--out", "") == {"runs", *FILENAMES}
    assert completions("mgehl", "new", "--kind", "") == {"point", "line", "wedge"}


@pytest.mark.parametrize("shell", SHELLS)
def test_the_shell_itself_accepts_its_script(script, shell, tmp_path):
    if shutil.which(shell) is None:
        pytest.skip(f"no {shell}")
    (tmp_path / "script").write_text(script(shell))
    flag = ["-c", "source script"] if shell == "tcsh" else ["-n", "script"]
    done = subprocess.run([shell, *flag], cwd=tmp_path, capture_output=True, text=True, timeout=30)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
