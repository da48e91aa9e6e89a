"""Runs read back from their directories."""

import shutil
from dataclasses import fields, is_dataclass
from math import isnan, nan

import h5netcdf
import numpy as np
import pytest
from mpi4py import MPI

from mgehl.config import config_from_tables
from mgehl.errors import OutputError
from mgehl.output.files import RunFiles, write_config, write_result
from mgehl.output.stored import read_result, read_run
from mgehl.run import _write, solve
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
            write_config(directory / "configuration.toml", made[kind][0].config)
            _write(RunFiles(directory), made[kind][0])
        return made[kind]

    return make


@pytest.fixture
def copy(written, tmp_path):
    """The files of a line contact, to be damaged."""
    return RunFiles(shutil.copytree(written("line")[1], tmp_path / "copy"))


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
    from dataclasses import replace

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
    assert "configuration.toml" in refused(tmp_path)


@pytest.mark.parametrize("name", ["configuration", "fields", "history", "result"])
def test_a_file_that_is_missing(copy, name):
    getattr(copy, name).unlink()
    assert getattr(copy, name).name in refused(copy.directory)


def test_a_run_that_has_not_finished(copy):
    copy.fields.unlink()
    assert "the run has not finished" in refused(copy.directory)


@pytest.mark.parametrize("name", ["fields", "history", "result"])
@pytest.mark.parametrize("what", [b"", b"\x00\x01\xff\n\xfe", b"{", b"a,b\n1\n", b"[1, 2]", b"null"])
def test_a_file_of_something_else(copy, name, what):
    getattr(copy, name).write_bytes(what)
    assert getattr(copy, name).name in refused(copy.directory)


@pytest.mark.parametrize("what", [b"\x00\x01\xff", b"[grid", b"[grid]\nnodes = 66\n"])
def test_a_configuration_that_is_none(copy, what):
    copy.configuration.write_bytes(what)
    assert refused(copy.directory)


@pytest.mark.parametrize("name", ["fields", "result"])
def test_a_file_cut_off(copy, name):
    path = getattr(copy, name)
    whole = path.read_bytes()
    for share in (0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99):
        path.write_bytes(whole[: int(share * len(whole))])
        assert path.name in refused(copy.directory)


@pytest.mark.parametrize("more", [0, 1, 2, 3])
def test_a_history_cut_off_within_a_row(copy, more):
    """Before its last number, or within that: what is left of it is a number, too."""
    whole = copy.history.read_bytes()
    copy.history.write_bytes(whole[: whole.rindex(b",") + more])
    assert "history.csv" in refused(copy.directory)


def test_bytes_changed_in_the_fields_give_one_line_or_do_no_harm(copy, written):
    solution, _ = written("line")
    whole, random = bytearray(copy.fields.read_bytes()), np.random.default_rng(4)
    refusals = 0
    for position in random.integers(0, len(whole), 150):
        whole[position] ^= 0xFF
        copy.fields.write_bytes(whole)
        whole[position] ^= 0xFF
        try:
            read = read_run(copy.directory)
        except OutputError as error:
            refusals += 1
            assert "\n" not in str(error)
        else:
            assert np.isfinite(read.fields.P).all() and read.fields.P.shape == solution.fields.P.shape
    assert refusals > 5


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
        assert read_run(copy.directory).H0 == -0.5

    def test_without_a_pressure(self, copy):
        self.change(copy.fields, H=None)
        assert "no fields of mgehl" in refused(copy.directory)

    def test_of_another_grid(self, copy):
        self.change(copy.fields, **{name: np.ones((3, 129)) for name in ("P", "H", "status")})
        assert "not of 129 x 1 nodes" in refused(copy.directory)

    @pytest.mark.parametrize("name", ["P", "H"])
    def test_not_a_number(self, copy, name):
        values = np.ones((1, 129))
        values[0, 7] = nan
        self.change(copy.fields, **{name: values})
        assert "not finite" in refused(copy.directory)

    @pytest.mark.parametrize(
        "status", [np.full((1, 129), 9), np.full((1, 129), -1), np.full((1, 129), 0.5)]
    )
    def test_a_status_that_there_is_not(self, copy, status):
        self.change(copy.fields, status=status)
        assert "a status that there is not" in refused(copy.directory)
