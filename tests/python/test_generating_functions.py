"""Generating functions: identities with the jet they come from, and the command's coefficients."""

import csv

import numpy as np
import pytest

import hamjet
from conftest import ORBIT, OSCILLATOR, command, scene


def states(jet, size, count=200):
    """Initial deviations and, through the jet, final ones."""
    initial = np.random.default_rng(2).uniform(-size, size, (count, len(jet.variables)))
    return initial, jet(initial)


def test_f1_of_the_oscillator_is_the_closed_form():
    # H = p^2/2 + 2 q^2 has the frequency 2: F1 = ((q^2 + q0^2) cos 2t - 2 q q0) / sin 2t.
    f1 = hamjet.run(OSCILLATOR).runs["gauss8"].jet.invert_partially("F1")
    assert f1.kind == "q-q" and f1.variables == ("q", "q0") and f1.order == 3
    assert f1.remaining_variables == ("p", "p0")
    angle = 2 * 1.25
    expected = {(2, 0): 1 / np.tan(angle), (0, 2): 1 / np.tan(angle), (1, 1): -2 / np.sin(angle)}
    for exponents, coefficient in zip(f1.exponents, f1.coefficients):
        assert abs(coefficient - expected.get(tuple(exponents), 0)) < 1e-14
    w = np.array([[0.3, -0.2], [1, 2]])
    values = f1.evaluate(w)
    assert values.shape == (2,)
    q, q0 = w.T
    exact = ((q**2 + q0**2) * np.cos(angle) - 2 * q * q0) / np.sin(angle)
    assert np.abs(values - exact).max() < 1e-13
    assert abs(f1.evaluate(w[0]) - exact[0]) < 1e-13


@pytest.mark.parametrize("kind", ["F1", "F2", "F3", "F4", "qpq-qqp", "auto"])
def test_the_remaining_variables_are_those_of_the_jet(jet, kind):
    function = jet.invert_partially(kind)
    assert sorted(function.variables + function.remaining_variables) == sorted(
        jet.components + tuple(name + "0" for name in jet.variables))

    def miss(size):
        initial, final = states(jet, size)
        columns = {name: final[:, i] for i, name in enumerate(jet.components)}
        columns |= {name + "0": initial[:, i] for i, name in enumerate(jet.variables)}
        w = np.column_stack([columns[name] for name in function.variables])
        right = np.column_stack([columns[name] for name in function.remaining_variables])
        # The gradient is the same but for its signs: + for p and q0, - for q and p0.
        signs = np.array([(1 if name.startswith("p") else -1) * (-1 if name.endswith("0") else 1)
                          for name in function.remaining_variables])
        remaining = function.remaining(w)
        assert np.abs(function.gradient(w) - signs * remaining).max() < 1e-9 * np.abs(right).max()
        return np.abs(remaining - right).max()

    # The inversion is exact up to degree 3: what it misses falls as the fourth power.
    assert 10**3.7 < miss(1e-4) / miss(1e-5) < 10**4.3


def test_the_gradient_is_that_of_the_polynomial(jet):
    f2 = jet.invert_partially("F2")
    w = np.random.default_rng(3).uniform(-0.01, 0.01, (50, 6))
    out = np.empty((50, 6))
    assert f2.gradient(w, out=out) is out
    for i in range(6):
        factors = f2.exponents[:, i].astype(float)
        lowered = f2.exponents.astype(int).copy()
        lowered[:, i] = np.maximum(lowered[:, i] - 1, 0)
        exact = np.prod(w[:, None, :] ** lowered[None], axis=2) @ (f2.coefficients * factors)
        assert np.abs(out[:, i] - exact).max() < 1e-13 * np.abs(exact).max()


def test_exactness_tells_a_symplectic_map_from_another(jet):
    exact = jet.exactness("F2")
    assert list(exact["degree"]) == [0, 1, 2]
    assert exact["scaled"].max() < 1e-10
    assert (exact == jet.invert_partially("F2").exactness).all()
    loose = hamjet.run(scene(ORBIT, integrator=[
        {"label": "fehlberg78", "method": "fehlberg78", "tolerance": 1e-5}])).runs["fehlberg78"].jet
    assert loose.exactness("F2")["scaled"][0] > 1e3 * exact["scaled"][0]


def test_coefficients_and_residuals_are_bit_by_bit_the_commands(tmp_path):
    tables = scene(ORBIT, generating_function={"kinds": ["F1", "auto"]})
    result = hamjet.run(tables)
    result.write(tmp_path / "out")
    run = result.runs["gauss8"]
    for entry in run.summary["exactness"]:
        function = run.jet.invert_partially(entry["requested"])
        with open(tmp_path / "out" / "gauss8" / f"generating_function_{entry['kind']}.csv",
                  encoding="utf-8", newline="") as file:
            rows = list(csv.reader(file))
        assert rows[0] == [f"e_{name}" for name in function.variables] + ["coefficient"]
        degrees = function.exponents.sum(axis=1)
        assert (np.array(rows[1:])[:, :-1].astype(int) == function.exponents[degrees >= 2]).all()
        stored = np.array([float(row[-1]) for row in rows[1:]])
        assert (stored == function.coefficients[degrees >= 2]).all()
        assert not function.coefficients[degrees < 2].any()
        assert [row["scaled"] for row in entry["by_degree"]] == list(function.exactness["scaled"])
        assert entry["condition"] == function.condition


def test_a_kind_that_does_not_exist_says_so():
    # Half a period of the oscillator: dq/dp0 = sin(2t)/2 vanishes.
    jet = hamjet.run(OSCILLATOR, overrides={"jet.duration_canonical": np.pi / 2}).runs["gauss8"].jet
    with pytest.raises(hamjet.NumericalError, match="singular"):
        jet.invert_partially("F1")
    assert jet.invert_partially("F2").kind == "q-p"
    with pytest.raises(hamjet.UsageError, match="F9"):
        jet.invert_partially("F9")
