"""Jets in files: what the command writes and reads, in both directions."""

import errno
import os
import pickle

import numpy as np
import pytest

import hamjet
from conftest import ORBIT, OSCILLATOR, command, message, scene

EXTENDED = {"precision": "extended", "integrator.gauss8.tolerance": 1e-28}


def same(a, b):
    """Whether two jets are the same bit by bit, with all that pickle keeps of them."""
    return pickle.dumps(a) == pickle.dumps(b)


@pytest.fixture(name="h5")
def file_of_hdf5(tmp_path):
    """The name of a file of HDF5, where this build has it."""
    probe = tmp_path / "probe.h5"
    try:
        hamjet.run(OSCILLATOR).runs["gauss8"].jet.save(probe)
    except hamjet.UsageError as error:
        pytest.skip(str(error))
    return tmp_path / "jet.h5"


@pytest.mark.parametrize("overrides", [None, EXTENDED])
@pytest.mark.parametrize("base", [ORBIT, OSCILLATOR], ids=["orbit", "oscillator"])
def test_a_jet_comes_back_with_all_its_bits(h5, base, overrides):
    jet = hamjet.run(base, overrides={**(overrides or {}), "jet.order": 2}).runs["gauss8"].jet
    jet.save(h5)
    again = hamjet.Jet.load(h5)
    assert same(again, jet)
    assert same(hamjet.Jet.load(str(h5), run="gauss8"), jet)
    points = np.random.default_rng(5).uniform(-1e-2, 1e-2, (20, len(jet.variables)))
    assert (again(points) == jet(points)).all()


def test_the_command_reads_what_save_writes_and_the_other_way_round(h5, tmp_path):
    result = hamjet.run(ORBIT)
    jet = result.runs["gauss8"].jet
    result.write(tmp_path / "out")
    jet.save(h5)
    made = command("convert", tmp_path / "out", tmp_path / "by-command.h5", directory=tmp_path)
    assert made.returncode == 0, made.stderr
    assert same(hamjet.Jet.load(tmp_path / "by-command.h5"), hamjet.Jet.load(tmp_path / "out"))
    arguments = ["--deviation", "0,-1000,0,0,0,0", "-q"]
    from_folder = command("eval", tmp_path / "out", *arguments, directory=tmp_path)
    from_file = command("eval", h5, *arguments, directory=tmp_path)
    assert from_file.returncode == 0, from_file.stderr
    states = [[float(field) for field in printed.stdout.splitlines()[1].split(",")[:6]]
              for printed in (from_folder, from_file)]
    assert states[0] == states[1]


@pytest.mark.parametrize("ending", [".csv", ".dace"])
def test_coefficients_alone_are_those_of_the_command(tmp_path, ending):
    result = hamjet.run(OSCILLATOR)
    jet = result.runs["gauss8"].jet
    result.write(tmp_path / "out")
    jet.save(tmp_path / f"jet{ending}")
    made = command("convert", tmp_path / "out", tmp_path / f"by-command{ending}",
                   directory=tmp_path)
    assert made.returncode == 0, made.stderr
    text = (tmp_path / f"jet{ending}").read_text(encoding="utf-8")
    assert text == (tmp_path / f"by-command{ending}").read_text(encoding="utf-8")
    # What they are of stands in the summary, which this file is not beside.
    with pytest.raises(hamjet.InputOutputError, match="no summary.json beside it"):
        hamjet.Jet.load(tmp_path / f"jet{ending}")
    jet.save(tmp_path / "out" / f"copy{ending}")
    again = hamjet.Jet.load(tmp_path / "out" / f"copy{ending}", run="gauss8")
    assert (again.coefficients == jet.coefficients).all()


def test_lost_digits_are_warned_of(tmp_path):
    jet = hamjet.run(OSCILLATOR, overrides=EXTENDED).runs["gauss8"].jet
    with pytest.warns(RuntimeWarning, match="^save: the .* holds 17 digits: the coefficients of "
                                            "extended precision are rounded$"):
        jet.save(tmp_path / "jet.dace")


def test_composed_and_inverted_jets_are_kept_too(h5, jet):
    for made in (jet.inverse(), jet.inverse() @ jet):
        made.save(h5, overwrite=True)
        assert same(hamjet.Jet.load(h5), made)


def test_a_missing_file_is_a_file_not_found_error(tmp_path):
    for name in ("none.h5", "none.dace", "none.csv"):
        with pytest.raises(FileNotFoundError) as raised:
            hamjet.Jet.load(tmp_path / name)
        assert isinstance(raised.value, hamjet.InputOutputError)
        assert raised.value.filename == str(tmp_path / name)
        printed = command("eval", tmp_path / name, "--deviation", "0,0,0,0,0,0",
                          directory=tmp_path)
        assert printed.returncode == 5 and message(printed) == str(raised.value)


def test_what_cannot_be_written_or_read_is_said(tmp_path, jet):
    result = hamjet.run(OSCILLATOR)
    result.write(tmp_path / "out")
    for path, error, text in (
            (tmp_path / "jet.txt", hamjet.UsageError, "must end in .h5, .dace or .csv"),
            (tmp_path / "out/gauss8/jet.csv", hamjet.UsageError,
             "is a file of results that would be replaced; choose another"),
            (tmp_path / "out/gauss8/jet.csv/jet.csv", hamjet.InputOutputError, "ot a directory"),
            (3, hamjet.UsageError, "path: wrong type, got int, must be a path"),
            ("a\0.csv", hamjet.UsageError, "path: not a path, got a NUL character in it")):
        with pytest.raises(error) as raised:
            jet.save(path)
        assert text in str(raised.value), path
    assert sorted(os.listdir(tmp_path)) == ["out"]
    (tmp_path / "jet.txt").write_text("", encoding="utf-8")
    with pytest.raises(hamjet.InputOutputError, match="is neither a results directory nor a file"):
        hamjet.Jet.load(tmp_path / "jet.txt")
    with pytest.raises(hamjet.UsageError, match="no run has the label gauss9; must be one of: g"):
        hamjet.Jet.load(tmp_path / "out", run="gauss9")


def test_a_file_is_replaced_whole_or_not_at_all(tmp_path, jet):
    file = tmp_path / "jet.csv"
    jet.save(file)
    before = file.read_bytes()
    other = scene(ORBIT, jet={"order": 1, "duration_canonical": 1})
    small = hamjet.run(other).runs["gauss8"].jet
    with pytest.raises(FileExistsError) as raised:
        small.save(file)
    assert isinstance(raised.value, hamjet.ExistingFileError)
    assert isinstance(raised.value, hamjet.InputOutputError)
    assert str(raised.value) == f"{file}: is there; overwrite=True would replace it"
    assert raised.value.filename == str(file) and raised.value.errno == errno.EEXIST
    assert str(pickle.loads(pickle.dumps(raised.value))) == str(raised.value)
    assert file.read_bytes() == before
    small.save(file, overwrite=True)
    assert file.read_bytes() != before
    assert os.listdir(tmp_path) == ["jet.csv"]


def test_no_folder_is_made(tmp_path, jet):
    file = tmp_path / "none" / "jet.csv"
    for overwrite in (False, True):
        with pytest.raises(FileNotFoundError) as raised:
            jet.save(file, overwrite=overwrite)
        assert isinstance(raised.value, hamjet.MissingFileError)
        assert str(raised.value) == (
            f"{file}: cannot be written: the folder {file.parent} is not there")
        assert raised.value.filename == str(file.parent)
    assert os.listdir(tmp_path) == []


def test_polynomials_from_elsewhere(tmp_path):
    jet = hamjet.run(OSCILLATOR).runs["gauss8"].jet
    jet.save(tmp_path / "x.dace")
    told = {"model": jet.model, "units": jet.units, "duration_canonical": jet.duration_canonical,
            "nominal_initial": list(jet.nominal_initial)}
    again = hamjet.Jet.load(tmp_path / "x.dace", **told)
    # The order is the highest degree that the file has: this map is linear.
    count = again.coefficients.shape[1]
    assert (again.order, count) == (1, 3)
    assert (again.coefficients == jet.coefficients[:, :count]).all()
    assert not jet.coefficients[:, count:].any()
    assert again.units.length_km == jet.units.length_km
    assert (again.nominal_initial == jet.nominal_initial).all()
    del told["units"]
    with pytest.raises(hamjet.UsageError, match="^load: a jet from elsewhere needs units as"):
        hamjet.Jet.load(tmp_path / "x.dace", **told)
