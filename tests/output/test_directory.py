"""A run directory: what is replaced, and what never is."""

import os
from pathlib import Path

import pytest

from mgehl.errors import OutputError
from mgehl.output.directory import (
    check_result,
    clear_checkpoint,
    install,
    make_directory,
    prepare_directory,
    seal,
)
from mgehl.output.manifest import Manifest, new_identity, read_manifest

NAMES = ("configuration.toml", "result.json", "laws/a.py")


def put(folder, text, names=NAMES, kind="run"):
    """A result of files that hold `text`, sealed; return the folder."""
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    seal(folder, kind, new_identity(), names)
    return folder


def stage_of(directory):
    return directory / "checkpoint" / "finished"


def content(directory):
    """{path: text, or where a link leads} of all that is in a directory."""
    found = {}
    for path in sorted(Path(directory).rglob("*")):
        if path.is_symlink():
            found[str(path.relative_to(directory))] = f"-> {os.readlink(path)}"
        elif not path.is_dir():
            found[str(path.relative_to(directory))] = path.read_text() if path.is_file() else "device"
    return found


class TestMaking:
    def test_it_is_created_with_its_parents(self, tmp_path):
        make_directory(tmp_path / "one" / "two")
        assert (tmp_path / "one" / "two").is_dir()

    def test_one_that_exists_is_refused(self, tmp_path):
        with pytest.raises(OutputError, match="--force"):
            make_directory(tmp_path)
        make_directory(tmp_path, force=True)

    @pytest.mark.parametrize("force", [False, True])
    def test_a_file_in_its_place_is_refused(self, tmp_path, force):
        (tmp_path / "file").write_text("mine")
        for path in (tmp_path / "file", tmp_path / "file" / "deep"):
            with pytest.raises(OutputError):
                make_directory(path, force)
        assert (tmp_path / "file").read_text() == "mine"


class TestForeign:
    """What mgehl did not write, --force leaves alone, and says so."""

    @pytest.mark.parametrize(
        "name",
        ["configuration.toml", "result.json", "history.csv", "fields.h5", "picture.png", "centerline.csv",
         "checkpoint/under-way.npz", "checkpoint/solve-0000.npz"],
    )  # fmt: skip
    def test_a_file_of_a_name_of_ours(self, tmp_path, name):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("mine")
        self.refused(tmp_path)

    def refused(self, directory):
        before = content(directory)
        with pytest.raises(OutputError, match="is left alone"):
            prepare_directory(directory)
        assert content(directory) == before

    def test_what_has_other_names_does_not_matter(self, tmp_path):
        (tmp_path / "checkpoint").mkdir()
        for name in ("notes.txt", "report.html", "checkpoint/epoch-7.pt"):
            (tmp_path / name).write_text("mine")
        before = content(tmp_path)
        prepare_directory(tmp_path)
        install(tmp_path, put(stage_of(tmp_path), "new"))
        clear_checkpoint(tmp_path)
        assert before.items() <= content(tmp_path).items()

    @pytest.mark.parametrize("name", ["result.json", "checkpoint", "laws"])
    def test_a_link_is_not_followed(self, tmp_path, name):
        there, here = tmp_path / "there", tmp_path / "here"
        for folder in (there, here):
            folder.mkdir()
        (there / "under-way.npz").write_text("precious")
        (here / name).symlink_to(there / "under-way.npz" if name == "result.json" else there)
        self.refused(here)
        assert (there / "under-way.npz").read_text() == "precious"

    def test_a_pipe_is_not_replaced(self, tmp_path):
        os.mkfifo(tmp_path / "picture.png")
        self.refused(tmp_path)

    def test_a_result_that_was_edited(self, tmp_path):
        put(tmp_path, "old")
        (tmp_path / "result.json").write_text("my own numbers")
        self.refused(tmp_path)

    def test_a_study(self, tmp_path):
        put(tmp_path, "tables", ("inlet.csv",), "study")
        with pytest.raises(OutputError, match="directory of a study"):
            prepare_directory(tmp_path)

    @pytest.mark.parametrize("name", ["../precious", "/etc/passwd", "laws/../../precious", "a/b", "..", ""])
    def test_a_manifest_names_nothing_outside(self, tmp_path, name):
        known = {name: "0" * 64}
        for manifest in (
            Manifest("run", new_identity(), known),
            Manifest("run", new_identity(), {}, {}, known),
        ):
            manifest.write(tmp_path)
            with pytest.raises(OutputError, match="manifest.json: is damaged: it names"):
                read_manifest(tmp_path)


class TestInstalling:
    def test_the_old_result_stays_until_the_new_one_is_whole(self, tmp_path):
        put(tmp_path, "old")
        prepare_directory(tmp_path)
        stage = put(stage_of(tmp_path), "new", NAMES[:2])
        assert content(tmp_path)["result.json"] == "old" and check_result(tmp_path)
        install(tmp_path, stage)
        clear_checkpoint(tmp_path)
        found = content(tmp_path)
        del found["manifest.json"]
        assert found == dict.fromkeys(NAMES[:2], "new") and check_result(tmp_path)
        assert not (tmp_path / "laws").exists()

    @pytest.mark.parametrize("moved", range(6))
    def test_an_end_in_between_leaves_enough_to_go_on_with(self, tmp_path, monkeypatch, moved):
        """After so many steps; whoever reads it then is refused."""
        put(tmp_path, "old", (*NAMES, "fields.h5"))
        identity = put(stage_of(tmp_path), "new") and read_manifest(stage_of(tmp_path)).identity
        steps = iter(range(moved))
        for name in ("replace", "unlink"):
            monkeypatch.setattr(f"pathlib.Path.{name}", counting(getattr(Path, name), steps))
        with pytest.raises(KeyboardInterrupt):
            install(tmp_path, stage_of(tmp_path))
        monkeypatch.undo()
        for name in content(tmp_path):
            if name in NAMES:
                assert content(tmp_path)[name] in ("old", "new")
        try:
            check_result(tmp_path)
        except OutputError:
            pass
        else:
            assert {content(tmp_path)[name] for name in NAMES} in ({"old"}, {"new"})
        prepare_directory(tmp_path)
        assert check_result(tmp_path).identity == identity
        assert content(tmp_path).keys() == {*NAMES, "manifest.json"}

    def test_what_came_in_the_way_stays_and_so_does_the_result(self, tmp_path):
        stage = put(stage_of(tmp_path), "new")
        (tmp_path / "result.json").write_text("mine")
        with pytest.raises(OutputError, match="is left alone"):
            install(tmp_path, stage)
        assert (tmp_path / "result.json").read_text() == "mine"
        assert (stage / "result.json").read_text() == "new"

    def test_a_report_of_the_result_before_goes(self, tmp_path):
        (tmp_path / "report.html").write_text('<head><meta name="generator" content="mgehl 0.1.0">')
        install(tmp_path, put(stage_of(tmp_path), "new"))
        assert not (tmp_path / "report.html").exists()


def counting(function, steps):
    """A function that ends the process, as it were, after so many calls of some."""

    def call(*arguments, **named):
        if next(steps, None) is None:
            raise KeyboardInterrupt
        return function(*arguments, **named)

    return call


class TestReading:
    @pytest.mark.parametrize("name", NAMES)
    def test_a_file_of_another_run_is_refused(self, tmp_path, name):
        one, other = (put(tmp_path / text, text) for text in ("one", "other"))
        (one / name).write_bytes((other / name).read_bytes())
        with pytest.raises(OutputError, match="is of another run"):
            check_result(one)

    def test_every_bit_of_a_manifest_counts(self, tmp_path):
        path = put(tmp_path, "one") / "manifest.json"
        whole = bytearray(path.read_bytes())
        for position in range(len(whole)):
            whole[position] ^= 1 << position % 8
            path.write_bytes(whole)
            whole[position] ^= 1 << position % 8
            try:
                found = read_manifest(tmp_path)
            except OutputError as error:
                assert "\n" not in str(error)
            else:  # a blank for another
                path.write_bytes(whole)
                assert found == read_manifest(tmp_path)

    def test_a_picture_may_be_missing_and_not_be_another(self, tmp_path):
        put(tmp_path, "one", (*NAMES, "picture.png"))
        (tmp_path / "picture.png").unlink()
        check_result(tmp_path)
        (tmp_path / "picture.png").write_text("other")
        with pytest.raises(OutputError, match="picture.png"):
            check_result(tmp_path)

    def test_one_that_has_not_finished_says_how_to_go_on(self, tmp_path):
        put(tmp_path / "checkpoint", "begun", NAMES, "begun run")
        with pytest.raises(OutputError, match="has not finished: go on with: mgehl run --resume"):
            check_result(tmp_path)

    def test_one_of_an_older_version_says_what_to_do(self, tmp_path):
        (tmp_path / "result.json").write_text("{}")
        with pytest.raises(OutputError, match="an older mgehl wrote it; make it again"):
            check_result(tmp_path)
