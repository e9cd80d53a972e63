"""All columns of studies: attributes hold what the CSV files and summary.json of the same study do."""

import dataclasses
import inspect
import pickle

import numpy as np
import pytest

import hamjet
from hamjet import _hamjet
from hamjet.studies import Columns
from test_bounded import EVENT, SCENE as BOUNDED, SHORT
from test_relative_motion import columns
from test_to_dataframe import VALIDITY

#: The study of each table that is a study's own.
STUDIES = {
    "validity": lambda: hamjet.validity(VALIDITY),
    "poincare": lambda: hamjet.poincare(BOUNDED, overrides=SHORT),
    "event": lambda: hamjet.event(BOUNDED, overrides=EVENT),
    "bounded": lambda: hamjet.bounded(
        BOUNDED.with_name("stationkeeping-follower.toml"),
        overrides=["bounded.revolutions=20", "bounded.box.days=2"]),
}
#: Columns of a whole result that summary.json has in another form.
NOT_IN_JSON = {"best", "not_assigned"}


def values(attribute):
    """All entries of an array, of nested tuples, or of one value, the last dimension fastest."""
    if isinstance(attribute, np.ndarray):
        return attribute.ravel().tolist()
    if isinstance(attribute, tuple):
        return [value for entry in attribute for value in values(entry)]
    return [attribute]


def same(value, field):
    """Whether a value is what a field of CSV, or an entry of JSON, says."""
    if value is None or value != value:
        return field in ("", None, "nan")
    if isinstance(value, (bool, np.bool_)):
        return field in ("true" if value else "false", bool(value))
    return value == (field if isinstance(value, str) else float(field))


def entries(json, dimensions, name):
    """The values of a column in summary.json, of all its rows."""
    if not dimensions or dimensions[0] not in json:
        found = json[name]
        return values(tuple(found)) if isinstance(found, list) else [found]
    return [value for row in json[dimensions[0]] for value in entries(row, dimensions[1:], name)]


@pytest.fixture(scope="module", params=STUDIES)
def studied(request, tmp_path_factory):
    study = STUDIES[request.param]()
    directory = tmp_path_factory.mktemp(request.param)
    study.write(directory)
    return request.param, study, directory


def expect_file(path, columns_of, declared):
    """The columns of a table, and its rows, are those of its CSV file."""
    file = columns(path.read_text(encoding="utf-8"))
    assert list(columns_of.table) == list(file)
    for column, fields in file.items():
        found = list(columns_of.table[column])
        assert len(found) == len(fields) and all(map(same, found, fields)), column
        if column in declared and declared[column][2]:
            entry = values(getattr(columns_of, column))
            assert len(entry) and all(map(same, entry, fields[::len(fields) // len(entry)])), column


def test_all_attributes_are_in_csv_and_json(studied):
    name, study, directory = studied
    declared = _hamjet.declarations()[name]
    expect_file(directory / f"{name}.csv", study, declared)
    place = study.summary.get(name, study.summary)
    for column, (_, _, dimensions) in declared.items():
        attribute = getattr(study, column)
        assert np.ndim(attribute) == len(dimensions) or isinstance(attribute, tuple), column
        if any(isinstance(dimension, str) and not isinstance(place.get(dimension), list)
               for dimension in dimensions[:1]):
            continue  # rows are in CSV alone
        if not dimensions and column in NOT_IN_JSON:
            continue
        expected = entries(place, [d for d in dimensions if isinstance(d, str)], column)
        found = values(attribute)
        assert len(found) == len(expected) and all(map(same, found, expected)), column


def test_further_tables_are_their_files(studied):
    name, study, directory = studied
    written = {path.stem for path in directory.glob("*.csv")} - {name, "event-map"}  # polynomials
    further = {table: attribute for table, attribute in vars(study).items()
               if isinstance(attribute, Columns)}
    assert written == {table for table, attribute in further.items() if attribute.table}
    for table, attribute in further.items():
        declared = _hamjet.declarations()[table]
        assert set(declared) == set(vars(attribute)) - {"table"}
        if table in written:
            expect_file(directory / f"{table}.csv", attribute, declared)


def test_attributes_are_documented_and_fixed(studied):
    name, study, _ = studied
    text = inspect.getdoc(type(study))
    for column, (unit, meaning, dimensions) in _hamjet.declarations()[name].items():
        line = next(line for line in text.splitlines() if line.strip().startswith(f"{column}:"))
        assert meaning in line and unit in line and all(str(d) in line for d in dimensions)
        assert column in dir(study)
        with pytest.raises(dataclasses.FrozenInstanceError):
            setattr(study, column, 0)
    again = pickle.loads(pickle.dumps(study))
    for column, value in vars(study).items():
        if isinstance(value, np.ndarray):
            assert np.array_equal(getattr(again, column), value, equal_nan=value.dtype.kind == "f")
            assert not value.flags.writeable and not getattr(again, column).flags.writeable
        elif not isinstance(value, Columns) and column not in ("table", "_study", "nearest", "farthest"):
            assert repr(values(getattr(again, column))) == repr(values(value)), column
    with pytest.raises(AttributeError):
        study.none_such
