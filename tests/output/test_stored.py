"""Runs read back from their directories."""

import shutil
from dataclasses import fields, is_dataclass, replace
from math import isnan, nan

import h5netcdf
import numpy as np
import pytest
from mpi4py import MPI

from mgehl.config import config_from_tables, load_config
from mgehl.errors import OutputError, UserError
from mgehl.output.files import RunFiles, write_result
from mgehl.output.finish import begin_run, finish_run
from mgehl.output.manifest import checksums, read_manifest
from mgehl.output.report.run_report import report
from mgehl.output.stored import read_result, read_run
from mgehl.run import run, solve
from mgehl.studies.study import PAPERS_DOMAIN, papers_grid

KINDS = {
    "point": {"motion": {"speed": 0.5}, "grid": papers_grid(65), "solver": {"start": "film"}},
    "contact": {"motion": {"speed": 5e-6}, "grid": papers_grid(65), "solver": {"start": "contact"}},
    "line": {
        "contact": {"kind": "line"},
        "motion": {"speed": 0.3},
        "grid": {"nodes": 129, "x": PAPERS_DOMAIN["x"]},
    },
    "wedge": {"contact": {"kind": "wedge"}, "grid": {"nodes": 65}},
}


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """Function: a solution of a kind and the directory it was written to, once for all tests."""
    made = {}

    def make(kind):
        if kind not in made:
            directory = tmp_path_factory.mktemp(kind)
            config = config_from_tables(KINDS[kind])
            made[kind] = solve(config, MPI.COMM_SELF), directory
            begin_run(directory, config)
            finish_run(MPI.COMM_SELF, directory, made[kind][0])
        return made[kind]

    return make


@pytest.fixture
def copy(written, tmp_path):
    """The files of a line contact, to be damaged."""
    return RunFiles(shutil.copytree(written("line")[1], tmp_path / "copy"))


def sealed(directory):
    """The directory with a manifest of its files as they are now: what a forger would do."""
    manifest = read_manifest(directory)
    replace(manifest, files=checksums(directory, manifest.files)).write(directory)
    return directory


def refused(directory):
    """What is said of a directory, in one line."""
    with pytest.raises(OutputError) as error:
        read_run(directory)
    text = str(error.value)
    assert "\n" not in text and str(directory) in text and len(text) < 400
    return text.removeprefix(f"{directory}")


@pytest.mark.parametrize("kind", KINDS)
def test_a_run_is_what_was_written(written, kind):
    solution, directory = written(kind)
    read = read_run(directory)
    assert read.config == solution.config
    for name in ("P", "H", "status"):
        ours, theirs = getattr(read.fields, name), getattr(solution.fields, name)
        assert ours.dtype == theirs.dtype
        np.testing.assert_array_equal(ours, theirs)
    assert read.H0 == solution.H0
    assert read.rows == solution.rows
    assert plain(read.result) == plain(solution.result)
    assert str(read) == str(solution)
    for name in ("x", "y", "film", "pressure", "status"):
        np.testing.assert_array_equal(getattr(read, name), getattr(solution, name))


def plain(value):
    """Lists for tuples: JSON has one kind of sequence."""
    if is_dataclass(value):
        return {field.name: plain(getattr(value, field.name)) for field in fields(value)}
    if isinstance(value, dict):
        return {key: plain(each) for key, each in value.items()}
    return [plain(each) for each in value] if isinstance(value, list | tuple) else value


def test_numbers_that_were_not_finite_are_nan_and_can_be_told(written, tmp_path):
    solution, _ = written("point")
    result = replace(solution.result, converged=False, settled=False, residual=nan, flux_imbalance=nan)
    files = RunFiles(tmp_path)
    write_result(files.result, result)
    read = read_result(files, solution.config)
    assert isnan(read.residual) and isnan(read.flux_imbalance) and read.converged is False
    assert read.central_film_nm == result.central_film_nm
    assert "residual nan" in str(replace(solution, result=read))


def test_what_is_no_directory(tmp_path):
    assert "is no run directory" in refused(tmp_path / "nowhere")
    assert "is no run directory" in refused(tmp_path)


@pytest.mark.parametrize("name", ["configuration", "fields", "history", "result"])
def test_a_file_that_is_missing(copy, name):
    getattr(copy, name).unlink()
    assert getattr(copy, name).name in refused(copy.directory)


def test_a_run_that_has_not_finished(copy):
    (copy.directory / "manifest.json").unlink()
    assert "it has not finished, or an older mgehl wrote it" in refused(copy.directory)


@pytest.mark.parametrize("name", ["fields", "history", "result"])
@pytest.mark.parametrize("what", [b"", b"\x00\x01\xff\n\xfe", b"{", b"a,b\n1\n", b"[1, 2]", b"null"])
def test_a_file_of_something_else(copy, name, what):
    getattr(copy, name).write_bytes(what)
    assert getattr(copy, name).name in refused(copy.directory)
    assert getattr(copy, name).name in refused(sealed(copy.directory))


@pytest.mark.parametrize("what", [b"\x00\x01\xff", b"[grid", b"[grid]\nnodes = 66\n"])
def test_a_configuration_that_is_none(copy, what):
    copy.configuration.write_bytes(what)
    assert refused(copy.directory) and refused(sealed(copy.directory))


@pytest.mark.parametrize("name", ["fields", "result"])
def test_a_file_cut_off(copy, name):
    path = getattr(copy, name)
    whole = path.read_bytes()
    for share in (0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99):
        path.write_bytes(whole[: int(share * len(whole))])
        assert path.name in refused(copy.directory) and path.name in refused(sealed(copy.directory))


@pytest.mark.parametrize("more", [0, 1, 2, 3])
def test_a_history_cut_off_within_a_row(copy, more):
    """Before its last number, or within that: what is left of it is a number, too."""
    whole = copy.history.read_bytes()
    copy.history.write_bytes(whole[: whole.rindex(b",") + more])
    assert "history.csv" in refused(copy.directory) and "history.csv" in refused(sealed(copy.directory))


@pytest.mark.parametrize("name", ["configuration", "fields", "history", "result"])
def test_every_byte_that_changed_is_found(copy, name):
    """HDF5 is not even asked: some of these make it hang."""
    path, random = getattr(copy, name), np.random.default_rng(4)
    whole = bytearray(path.read_bytes())
    for position in random.integers(0, len(whole), 60):
        whole[position] ^= 1 << int(random.integers(8))
        path.write_bytes(whole)
        assert f"{path.name}: is damaged, was edited" in refused(copy.directory)
        path.write_bytes(bytes(whole))
        whole = bytearray(whole)


@pytest.mark.parametrize("converged", ['"no"', '"yes"', "1", "null", "[]"])
def test_a_verdict_is_true_or_false_and_nothing_like_it(copy, converged):
    text = copy.result.read_text().replace('"converged": true', f'"converged": {converged}')
    copy.result.write_text(text)
    assert "result.json: cannot be read" in refused(sealed(copy.directory))


@pytest.mark.parametrize("number", ['"12"', "true", "[]"])
def test_a_number_is_no_word(copy, number):
    text = copy.result.read_text().replace('"wall_s": ', f'"wall_s": {number}, "was": ')
    copy.result.write_text(text)
    assert "result.json: cannot be read" in refused(sealed(copy.directory))


def test_a_domain_that_is_open_is_none_of_a_finished_run(copy):
    """It would have to be found by a film, and a user's own law may have a say in that."""
    text = copy.configuration.read_text()
    begin, end = text.index("x = ["), text.index("]", text.index("x = [")) + 1
    copy.configuration.write_text(f'{text[:begin]}x = "auto"{text[end:]}')
    assert "no domain in numbers" in refused(sealed(copy.directory))


class TestOwnLaws:
    """Reading a run runs nothing of it."""

    LAW = "def waves(x, y):\n    return 1e-9 + 0.0 * x * y\n\ndef liner(k):\n    return 1.0 + 0.0 * k\n"
    TRAP = "raise SystemExit('the law was run')\n"

    @pytest.fixture
    def laid(self, tmp_path):
        """A run directory with laws that fail where they are run."""
        (tmp_path / "a.py").write_text(self.LAW)
        own = {"surface": f"{tmp_path / 'a.py'}:waves", "deformation": f"{tmp_path / 'a.py'}:liner"}
        tables = {"contact": own, "solver": {"error": False}} | {"grid": papers_grid(65)}
        config = config_from_tables(tables | {"motion": {"speed": 1.0}})
        run(config, self.made(tmp_path), MPI.COMM_SELF)
        return tmp_path / "run"

    def made(self, tmp_path):
        (tmp_path / "run").mkdir()
        return tmp_path / "run"

    def test_nothing_is_run(self, laid):
        (laid / "laws" / "a.py").write_text(self.TRAP)
        for name in ("film", "report", "export"):
            getattr(self, f"use_{name}")(read_run(sealed(laid)), laid)

    def use_film(self, solution, _):
        assert solution.film.min() > 0.0 and str(solution)
        with pytest.raises(UserError, match="is not run where results are read"):
            _ = solution.contact.roughness

    def use_report(self, solution, _):
        assert "a.py:waves" in report(solution, "run")

    def use_export(self, solution, laid):
        from mgehl.output.export.export import export

        export(solution, {each: laid / f"out.{each}" for each in ("nc", "npz", "csv")})

    def test_the_directory_knows_no_machine(self, laid, tmp_path):
        for path in laid.rglob("*"):
            if path.is_file():
                assert str(tmp_path).encode() not in path.read_bytes(), path
        assert (laid / "laws" / "a.py").read_text() == self.LAW

    def test_it_runs_again_elsewhere(self, laid, tmp_path):
        elsewhere = laid.rename(tmp_path / "elsewhere")
        (tmp_path / "a.py").unlink()
        again = solve(load_config(elsewhere / "configuration.toml"), MPI.COMM_SELF)
        np.testing.assert_array_equal(again.fields.H, read_run(elsewhere).fields.H)


class TestFields:
    def change(self, path, **values):
        """Write fields.h5 anew with other values, as another program might."""
        with h5netcdf.File(path) as file:
            arrays = {name: np.asarray(file[name]) for name in ("P", "H", "status")}
        arrays |= {name: value for name, value in values.items() if value is not None}
        ny, nx = arrays["P"].shape
        with h5netcdf.File(path, "w") as file:
            file.dimensions = {"y": ny, "x": nx}
            file.attrs["H0"] = -0.5
            for name, array in arrays.items():
                if name not in values or values[name] is not None:
                    file.create_variable(name, ("y", "x"), array.dtype, data=array)

    def test_of_another_program(self, copy):
        self.change(copy.fields, P=np.zeros((1, 129)))
        assert "fields.h5" in refused(copy.directory)
        assert read_run(sealed(copy.directory)).H0 == -0.5

    def test_without_a_pressure(self, copy):
        self.change(copy.fields, H=None)
        assert "no fields of mgehl" in refused(sealed(copy.directory))

    def test_of_another_grid(self, copy):
        self.change(copy.fields, **{name: np.ones((3, 129)) for name in ("P", "H", "status")})
        assert "not of 129 x 1 nodes" in refused(sealed(copy.directory))

    @pytest.mark.parametrize("name", ["P", "H"])
    def test_not_a_number(self, copy, name):
        values = np.ones((1, 129))
        values[0, 7] = nan
        self.change(copy.fields, **{name: values})
        assert "not finite" in refused(sealed(copy.directory))

    @pytest.mark.parametrize(
        "status", [np.full((1, 129), 9), np.full((1, 129), -1), np.full((1, 129), 0.5)]
    )
    def test_a_status_that_there_is_not(self, copy, status):
        self.change(copy.fields, status=status)
        assert "a status that there is not" in refused(sealed(copy.directory))
