"""Pickles and copies: the same object again, bit by bit, and as read-only as before."""

import concurrent.futures
import copy
import dataclasses
import multiprocessing
import pickle
import subprocess
import sys

import numpy as np
import pytest

import hamjet
from conftest import ORBIT, OSCILLATOR, SOURCE, scene

EXTENDED = {"precision": "extended", "integrator.gauss8.tolerance": 1e-28}
DATED = scene(ORBIT, ephemeris={"epoch": "2026-03-01T00:00:00", "time_system": "UTC",
                                "reference_frame": "TOD", "center_name": "EARTH"})

#: pickle.loads(pickle.dumps(...)) with every protocol, and in another process.
PROTOCOLS = range(2, pickle.HIGHEST_PROTOCOL + 1)


def properties(value):
    """All that an object shows, arrays and numbers as their bytes."""
    shown = {}
    for name in dir(value):
        entry = getattr(value, name)
        if name.startswith("_") or callable(entry):
            continue
        if isinstance(entry, np.ndarray):
            entry = (entry.dtype.str, entry.shape, entry.tobytes(), entry.flags.writeable)
        elif isinstance(entry, hamjet.Units):
            entry = (entry.length_km.hex(), entry.time_s.hex())
        shown[name] = entry
    return shown


@pytest.fixture(scope="module", params=["double", "extended", "some variables", "dated"])
def any_jet(request):
    if request.param == "extended":
        return hamjet.run(OSCILLATOR, overrides=EXTENDED).runs["gauss8"].jet
    if request.param == "some variables":
        return hamjet.run(ORBIT, overrides={"jet.variables": ["px", "py"]}).runs["gauss8"].jet
    return hamjet.run(DATED if request.param == "dated" else ORBIT).runs["gauss8"].jet


def test_a_jet_comes_back_bit_by_bit(any_jet):
    expected = properties(any_jet)
    assert {"coefficients", "exponents", "nominal_final", "units"} <= expected.keys()
    points = np.random.default_rng(3).uniform(-1e-2, 1e-2, (40, len(any_jet.variables)))
    for protocol in PROTOCOLS:
        again = pickle.loads(pickle.dumps(any_jet, protocol))
        assert properties(again) == expected
        assert (again.evaluate(points) == any_jet.evaluate(points)).all()
        with pytest.raises(ValueError):
            again.coefficients[0, 0] = 1
        # All digits of an extended jet, and not those shown alone.
        if again.variables == again.components:
            assert (again.symplecticity() == any_jet.symplecticity()).all()
            assert (again.inverse().coefficients == any_jet.inverse().coefficients).all()


def test_a_generating_function_comes_back_bit_by_bit(any_jet):
    if any_jet.variables != any_jet.components:
        pytest.skip("has none")
    function = any_jet.invert_partially("auto")
    again = pickle.loads(pickle.dumps(function))
    assert properties(again) == properties(function)
    w = np.random.default_rng(3).uniform(-1e-3, 1e-3, (40, len(function.variables)))
    for name in ("evaluate", "gradient", "remaining"):
        assert (getattr(again, name)(w) == getattr(function, name)(w)).all()


FAR = scene(ORBIT, nominal={**ORBIT["nominal"], "raan_deg": 20, "argp_deg": 40, "ta_deg": 10})
STATES = np.random.default_rng(4).uniform(-1, 1, (40, 6)) * ([1e3, 2e4, 1e3] + [1] * 3)


@pytest.mark.parametrize("start, end", [
    ("flow-box", "flow-box"), ("nodal", "poincare"), ("spherical", "cartesian"),
    ("cartesian", "cartesian")])
def test_polynomials_come_back_bit_by_bit(start, end):
    whole = hamjet.polynomials(FAR, coordinates=start, end_coordinates=end)
    # Estimates of orders 2 to 4 are by one degree more, whose chief ends elsewhere by some bits.
    for order in (2, 3, 4):
        polynomials = hamjet.polynomials(FAR, coordinates=start, end_coordinates=end,
                                         overrides={"jet.order": order})
        again = pickle.loads(pickle.dumps(polynomials))
        for found, wanted in zip(again.evaluate_relative(STATES),
                                 polynomials.evaluate_relative(STATES)):
            assert found.tobytes() == wanted.tobytes()
    polynomials = whole
    expected = polynomials.evaluate_relative(STATES)
    for protocol in PROTOCOLS:
        again = pickle.loads(pickle.dumps(polynomials, protocol))
        assert properties(again) == properties(polynomials) and repr(again) == repr(polynomials)
        for found, wanted in zip(again.evaluate_relative(STATES), expected):
            assert found.tobytes() == wanted.tobytes()
        for degree in (1, 2):
            found = again.evaluate_relative(STATES, degree=degree).states
            assert (found == polynomials.evaluate_relative(STATES, degree=degree).states).all()
    assert copy.copy(polynomials) is polynomials and copy.deepcopy(polynomials) is polynomials
    with pytest.raises(hamjet.UsageError, match="^reach: deputies are flown in a scene"):
        again.reach()


def test_loaded_polynomials_come_back_bit_by_bit(tmp_path):
    hamjet.run(FAR, overrides={"jet.coordinates": "flow-box", "precision": "double"}).write(
        tmp_path / "out")
    loaded = hamjet.Polynomials.load(tmp_path / "out")
    assert loaded.coordinates == "flow-box"
    again = pickle.loads(pickle.dumps(loaded))
    for found, wanted in zip(again.evaluate_relative(STATES), loaded.evaluate_relative(STATES)):
        assert found.tobytes() == wanted.tobytes()


def test_other_processes_evaluate_the_same_digits():
    polynomials = hamjet.polynomials(FAR, coordinates="flow-box")
    expected = polynomials.evaluate_relative(STATES)
    with concurrent.futures.ProcessPoolExecutor(
            2, mp_context=multiprocessing.get_context("spawn")) as pool:
        parts = list(pool.map(hamjet.Polynomials.evaluate_relative, [polynomials] * 2,
                              [STATES[:16], STATES[16:]], timeout=60))
    assert all(part.columns == expected.columns for part in parts)
    for found, wanted in zip(zip(*parts), expected):
        assert np.concatenate(found).tobytes() == wanted.tobytes()


def same(a, b):
    if isinstance(a, np.ndarray):
        return (a.dtype, a.shape, a.tobytes(), a.flags.writeable) == (
            b.dtype, b.shape, b.tobytes(), b.flags.writeable)
    if isinstance(a, (hamjet.Jet, hamjet.Units)):
        return properties(a) == properties(b)
    if dataclasses.is_dataclass(a):
        return all(same(getattr(a, field.name), getattr(b, field.name))
                   for field in dataclasses.fields(a)
                   if field.name not in ("_propagation", "_report"))
    if isinstance(a, dict) or hasattr(a, "items"):
        return type(a) is type(b) and a.keys() == b.keys() and all(same(a[k], b[k]) for k in a)
    return a == b


def test_a_result_comes_back_but_for_its_files(tmp_path):
    figure = {"quantity": "exactness", "kind": "F1"}
    result = hamjet.run(scene(ORBIT, figure=figure, generating_function={"kinds": ["F1"]}))
    again = pickle.loads(pickle.dumps(result))
    assert same(again, result) and again.summary == result.summary
    run = again.runs["gauss8"]
    assert same(pickle.loads(pickle.dumps(run)), result.runs["gauss8"])
    for array in (run.nominal.states, run.along_time.condition):
        assert not array.flags.writeable
    with pytest.raises(TypeError):
        again.runs["other"] = run
    with pytest.raises(hamjet.UsageError, match="^write: these results were read from files, or"):
        again.write(tmp_path / "out")
    result.write(tmp_path / "out")
    loaded = hamjet.load(tmp_path / "out")
    assert same(pickle.loads(pickle.dumps(loaded)), loaded)


def test_a_result_of_another_study_comes_back_whole(tmp_path):
    study = hamjet.run(SOURCE / "data" / "scenes" / "paper" / "energy-midpoint-kepler.toml",
                       overrides={"energy_conservation.duration_orbits": 0.5})
    again = pickle.loads(pickle.dumps(study))
    assert same(again, study) and again.summary == study.summary
    study.write(tmp_path / "before")
    again.write(tmp_path / "after")
    names = sorted(path.name for path in (tmp_path / "before").iterdir())
    assert names == sorted(path.name for path in (tmp_path / "after").iterdir())
    for name in names:
        before = (tmp_path / "before" / name).read_bytes()
        assert (tmp_path / "after" / name).read_bytes() == before, name


def test_a_copy_of_what_cannot_change_is_itself():
    result = hamjet.run(OSCILLATOR)
    run = result.runs["gauss8"]
    for value in (result, run, run.jet, run.jet.units, run.nominal,
                  run.jet.invert_partially("F1")):
        assert copy.copy(value) is value and copy.deepcopy(value) is value
    assert copy.deepcopy({"jet": run.jet})["jet"] is run.jet


def test_another_process_reads_a_pickle(tmp_path, jet):
    file = tmp_path / "jet.pickle"
    file.write_bytes(pickle.dumps((jet, jet.units)))
    text = subprocess.run(
        [sys.executable, "-c",
         "import pickle, sys\n"
         "jet, units = pickle.load(open(sys.argv[1], 'rb'))\n"
         "print(jet.coefficients.tobytes().hex(), units.time_s.hex())", file],
        check=True, capture_output=True, text=True).stdout
    assert text.split() == [jet.coefficients.tobytes().hex(), jet.units.time_s.hex()]


def test_what_is_no_state_is_refused(jet):
    restore, (function, state, coefficients) = jet.__reduce__()
    for wrong in ((state[:9] + ([0, 99],) + state[10:], coefficients),
                  (state, coefficients[:, 1:]), (state, coefficients[1:]),
                  (state[:2] + (99,) + state[3:], coefficients)):
        with pytest.raises(hamjet.UsageError, match="^pickle: this is no state"):
            restore(function, *wrong)
    polynomials = hamjet.polynomials(FAR, coordinates="flow-box")
    restore, (function, state, coefficients, *numbers) = polynomials._study.__reduce__()
    # Coordinates that there are not, those of one end alone, measured ones, and no section; and
    # none of them is a jet in positions and momenta.
    for wrong in ((99, 5), (5, 0), (6, 6), (3, 3)):
        with pytest.raises(hamjet.UsageError, match="^pickle: this is no state"):
            restore(function, state[:13] + wrong + state[15:], coefficients, *numbers)
    for wrong in (state[:15] + (None,) + state[16:], state[:14] + state[14:15] +
                  ((9,) + state[15][1:],) + state[16:]):
        with pytest.raises(hamjet.UsageError, match="^pickle: this is no state"):
            restore(function, wrong, coefficients, *numbers)
    with pytest.raises(hamjet.UsageError, match="^pickle: this is no state"):
        restore("_restored_jet", state, coefficients)
