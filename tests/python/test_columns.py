"""All columns of studies: attributes hold what the CSV files and summary.json of the same study do."""

import dataclasses
import functools
import inspect
import operator
import pickle

import numpy as np
import pytest

import hamjet
from conftest import SOURCE
from hamjet import _hamjet
from hamjet.studies import Columns
from test_bounded import EVENT, SCENE as BOUNDED, SHORT
from test_motion import CIRCLES
from test_relative_motion import TRANSFER, columns
from test_to_dataframe import VALIDITY
from test_uncertainty import SCENE as UNCERTAINTY

UNCERTAIN_PAIR = UNCERTAINTY + """
[uncertainty.collision]
radius_m = 50
samples = 2000
[uncertainty.safety]
keep_apart_m = 50
keep_out_m = [100, 200, 100]
samples = 100
"""

#: By the name of the study's own table, the first word.
STUDIES = {
    "validity": lambda: hamjet.validity(VALIDITY),
    "motion": lambda: hamjet.motion(CIRCLES),
    "transfers": lambda: hamjet.transfer(TRANSFER, overrides={
        "transfer.count": 3, "transfer.impulses": "optimal", "transfer.thrust": "energy-optimal",
        "transfer.feedback": 2, "transfer.errors": {"magnitude": 0.01, "samples": 10},
        "transfer.budget_m_s": 20, "thruster": {"acceleration_m_s2": 0.1}, "transfer.waypoint": [
            {"time_s": 1000, "position_m": [0, -500, 200]}]}),
    "transfers of full thrust": lambda: hamjet.transfer(TRANSFER, overrides={
        "transfer.count": 1, "transfer.thrust": "fuel-optimal",
        "thruster": {"acceleration_m_s2": 0.005}}),
    "assignment": lambda: hamjet.assign(
        SOURCE / "data" / "scenes" / "assignment-tetrahedron.toml", overrides=["transfer.count=3"]),
    "moments": lambda: hamjet.uncertainty(UNCERTAIN_PAIR),
    "poincare": lambda: hamjet.poincare(BOUNDED, overrides=SHORT),
    "event": lambda: hamjet.event(BOUNDED, overrides=EVENT),
    "periodic": lambda: hamjet.periodic(
        SOURCE / "data" / "scenes" / "own" / "earth-moon-halo-l2.toml",
        overrides=["periodic.family.to=1.6"]),
    "bounded": lambda: hamjet.bounded(
        BOUNDED.with_name("stationkeeping-follower.toml"),
        overrides=["bounded.revolutions=20", "bounded.box.days=2"]),
}
#: Where summary.json has the columns of further tables.
PLACES = {"collision": ["collision"], "least_separation": ["collision", "least_separation"],
          "approaches": ["collision"], "safety": ["safety"],
          "frozen_orbit": ["frozen_orbit"], "box": ["box"]}
#: Columns that summary.json has in another form, or not.
NOT_IN_JSON = {"best", "not_assigned", "start_change_m_s_by_order", "end_change_m_s_by_order"}


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
        found = json[name] if name in json else json["transfer"][name]  # of an assigned deputy
        return values(tuple(found)) if isinstance(found, list) else [found]
    return [value for row in json[dimensions[0]] for value in entries(row, dimensions[1:], name)]


@pytest.fixture(scope="module", params=STUDIES)
def studied(request, tmp_path_factory):
    study = STUDIES[request.param]()
    directory = tmp_path_factory.mktemp(request.param.split()[0])
    study.write(directory)
    return request.param.split()[0], study, directory


def tables(own, study):
    """A study's own table, and further ones, by name."""
    return {own: study, **{further: value for further, value in vars(study).items()
                           if isinstance(value, Columns)}}


def is_empty(table):
    return not any(len(column) for column in table.table.values())


def expect_file(path, table, declared):
    """The columns of a table, and its rows, are those of its CSV file; no rows without a file."""
    if not path.exists():
        assert is_empty(table)
        return
    file = columns(path.read_text(encoding="utf-8"))
    assert list(table.table) == list(file)
    for column, fields in file.items():
        found = list(table.table[column])
        assert len(found) == len(fields) and all(map(same, found, fields)), column
        if column in declared and declared[column][2]:
            entry = values(getattr(table, column))
            assert len(entry) and all(map(same, entry, fields[::len(fields) // len(entry)])), column


def expect_summary(place, table, declared):
    """The columns of a table are those of an object in summary.json, or absent in both."""
    for column, (_, _, dimensions) in declared.items():
        names = [d for d in dimensions if isinstance(d, str) and d != "any"]
        if (names and not isinstance(place.get(names[0]), list)) or column in NOT_IN_JSON:
            continue  # rows are in CSV alone
        found = values(getattr(table, column))
        if not names and column not in place and all(v is None or v != v for v in found):
            continue
        expected = entries(place, names, column)
        assert len(found) == len(expected) and all(map(same, found, expected)), column


def test_all_attributes_are_in_csv_and_json(studied):
    own, study, directory = studied
    for name, table in tables(own, study).items():
        declared = _hamjet.declarations()[name]
        expect_file(directory / f"{name}.csv", table, declared)
        for column, (_, _, dimensions) in declared.items():
            attribute = getattr(table, column)
            if dimensions and not isinstance(attribute, tuple):
                assert np.ndim(attribute) == len(dimensions), column
        if name == own:
            expect_summary(study.summary.get(name, study.summary), table, declared)
        elif name in PLACES:
            expect_summary(functools.reduce(operator.getitem, PLACES[name], study.summary), table, declared)


def test_further_tables_are_their_files(studied):
    name, study, directory = studied
    written = {path.stem for path in directory.glob("*.csv")} - {name, "event-map"}  # polynomials
    further = {table: attribute for table, attribute in vars(study).items()
               if isinstance(attribute, Columns)}
    assert written == {table for table, attribute in further.items() if not is_empty(attribute)}
    for table, attribute in further.items():
        assert set(_hamjet.declarations()[table]) == set(vars(attribute)) - {"table"}


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
