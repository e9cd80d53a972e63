"""All columns of studies: attributes hold what the CSV files and summary.json of the same study do."""

import dataclasses
import inspect
import pickle

import numpy as np
import pytest

import hamjet
from hamjet import _hamjet
from test_relative_motion import columns
from test_to_dataframe import VALIDITY

STUDIES = {"validity": lambda: hamjet.validity(VALIDITY)}


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
    if isinstance(value, bool):
        return field in ({True: "true", False: "false"}[value], value)
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


def test_all_attributes_are_in_csv_and_json(studied):
    name, study, directory = studied
    declared = _hamjet.declarations()[name]
    file = columns((directory / f"{name}.csv").read_text(encoding="utf-8"))
    assert list(study.table) == list(file)
    for column, fields in file.items():
        found = study.table[column].tolist() if isinstance(study.table[column], np.ndarray) else (
            study.table[column])
        assert len(found) == len(fields)
        assert all(map(same, found, fields)), column
    place = study.summary[name]
    for column, (_, _, dimensions) in declared.items():
        attribute = getattr(study, column)
        assert np.ndim(attribute) == len(dimensions) or isinstance(attribute, tuple), column
        expected = entries(place, [d for d in dimensions if isinstance(d, str)], column)
        found = values(attribute)
        assert len(found) == len(expected) and all(map(same, found, expected)), column
        if column in file and dimensions:
            step = len(fields) // len(found)
            assert all(map(same, found, file[column][::step])), column


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
        elif column not in ("table", "_study"):
            assert values(getattr(again, column)) == values(value), column
    with pytest.raises(AttributeError):
        study.none_such
