"""Jets of arrays: those of hamjet come back, others are checked."""

import warnings

import numpy as np
import pytest

import hamjet

#: A rotation by the angle 0.3 with a cubic kick after it: exp(0.3 J), then p -= 0.5 q^3.
COSINE, SINE = np.cos(0.3), np.sin(0.3)
ROTATION = {"nominal_initial": [0.0, 0.0], "duration_canonical": 0.3,
            "units": hamjet.Units(0.001, 1.0), "model": "own"}


def described(jet):
    return {"nominal_initial": jet.nominal_initial, "duration_canonical": jet.duration_canonical,
            "units": jet.units, "model": jet.model}


def kicked_rotation():
    """Coefficients and exponents of (q, p) -> (Q, P - 0.5 Q^3), Q = c q + s p, P = -s q + c p."""
    c, s = COSINE, SINE
    exponents = [[0, 0], [1, 0], [0, 1], [3, 0], [2, 1], [1, 2], [0, 3]]
    cubic = [c**3, 3 * c * c * s, 3 * c * s * s, s**3]
    return np.array([[0, c, s, 0, 0, 0, 0],
                     [0, -s, c, *(-0.5 * a for a in cubic)]]), np.array(exponents)


def test_a_jet_is_the_same_from_its_arrays_in_any_order(jet):
    order = np.random.default_rng(6).permutation(jet.coefficients.shape[1])
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # it is symplectic
        again = hamjet.Jet.from_arrays(jet.coefficients[:, order], jet.exponents[order],
                                       **described(jet), scene=jet.scene, run=jet.run)
    for name in ("coefficients", "exponents", "nominal_initial", "nominal_final", "linear_part"):
        assert (getattr(again, name) == getattr(jet, name)).all(), name
    for name in ("order", "model", "variables", "components", "duration_s", "scene", "run",
                 "precision"):
        assert getattr(again, name) == getattr(jet, name), name
    points = np.random.default_rng(7).uniform(-1e-2, 1e-2, (10, 6))
    assert (again(points) == jet(points)).all()
    assert (again.evaluate_relative([[10.0] * 6]).states
            == jet.evaluate_relative([[10.0] * 6]).states).all()


def test_terms_that_are_left_out_are_zero():
    coefficients, exponents = kicked_rotation()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        jet = hamjet.Jet.from_arrays(coefficients, exponents, **ROTATION)
    assert (jet.order, jet.variables, jet.coefficients.shape) == (3, ("q", "p"), (2, 10))
    q, p = 0.4, -0.2
    Q, P = COSINE * q + SINE * p, -SINE * q + COSINE * p
    assert np.allclose(jet([q, p]), [Q, P - 0.5 * Q**3], rtol=0, atol=1e-15)
    assert jet.symplecticity()["scaled"].max() < 1e-15
    # The kick is undone, then the rotation.
    Q, P = COSINE * q - SINE * (p + 0.5 * q**3), SINE * q + COSINE * (p + 0.5 * q**3)
    assert np.allclose(jet.inverse()([q, p]), [Q, P], rtol=0, atol=1e-15)


def test_a_map_that_is_not_symplectic_is_reported_and_kept():
    coefficients, exponents = kicked_rotation()
    coefficients[1, 1:3] *= 2  # {Q, P} = 2
    with pytest.warns(RuntimeWarning, match="^from_arrays: not the jet of a symplectic map: the "
                                            r"scaled defect is 0.33 at degree 0; see"):
        jet = hamjet.Jet.from_arrays(coefficients, exponents, **ROTATION)
    # |2 - 1| over |c 2c| + |s 2s| + |1|.
    assert np.isclose(jet.symplecticity()["scaled"][0], 1 / 3, rtol=1e-14)
    assert jet.symplecticity()["absolute"][0] == pytest.approx(1, rel=1e-14)


def test_some_variables_and_components(jet):
    rows = (jet.exponents[:, [0, 1, 2, 4, 5]] == 0).all(axis=1)
    part = hamjet.Jet.from_arrays(jet.coefficients[:3, rows], jet.exponents[rows][:, 3:4],
                                  **described(jet), variables=["px"], components=("x", "y", "z"))
    assert part.variables == ("px",) and part.components == ("x", "y", "z")
    assert (part.nominal_final == [*jet.nominal_final[:3], 0, 0, 0]).all()
    assert (part.linear_part == jet.linear_part[:3, 3:4]).all()


COEFFICIENTS, EXPONENTS = kicked_rotation()


@pytest.mark.parametrize("change, text", [
    ({"coefficients": COEFFICIENTS[:1]}, "got coefficients of shape (1, 7) and exponents of shape "
     "(7, 2), must be (2, count) and (count, 2)"),
    ({"exponents": EXPONENTS[:6]}, "got coefficients of shape (2, 7) and exponents of shape (6, 2),"
     " must be (2, count) and (count, 2)"),
    ({"coefficients": COEFFICIENTS[0]}, "coefficients: must be an array of real numbers of at most "
     "64 bits with 2 dimensions"),
    ({"coefficients": COEFFICIENTS * 1j}, "coefficients: must be an array of real numbers of at "
     "most 64 bits with 2 dimensions"),
    ({"coefficients": [[1, 2], [3]]}, "coefficients: must be an array of real numbers of at most 64"
     " bits with 2 dimensions"),
    ({"exponents": EXPONENTS * 1.0}, "exponents: must be an array of integers with 2 dimensions"),
    ({"coefficients": np.where(COEFFICIENTS == COSINE, np.nan, COEFFICIENTS)},
     "coefficients: not finite, got nan at position 1, must be finite"),
    ({"exponents": EXPONENTS - 1}, "exponents: row 0 has -1, must be from 0, of degree at most 20"),
    ({"exponents": EXPONENTS * 7}, "exponents: row 3 has 21, must be from 0, of degree at most 20"),
    ({"exponents": EXPONENTS * 0}, "exponents: got degree 0 alone, must be a map"),
    ({"exponents": EXPONENTS[[0, 1, 2, 3, 4, 5, 5]]}, "exponents: row 6 is there twice, (1, 2)"),
    ({"exponents": EXPONENTS + [1, 0]}, "exponents: without the row of zeros, whose coefficients "
     "must be the nominal's final state"),
    ({"model": "keplr"}, 'model: got "keplr", did you mean kepler?'),
    ({"model": "kepler"}, "nominal_initial: got 2 numbers, must be 6 of the model kepler"),
    ({"model": "fermi-pasta-ulam", "nominal_initial": [0.0]}, "nominal_initial: got 1 numbers, must"
     " be 4 or 8 or 12 or 16 of the model fermi-pasta-ulam"),
    ({"nominal_initial": [0, np.inf]}, "nominal_initial: not finite, got inf at position 1, must be"
     " finite"),
    ({"duration_canonical": np.inf}, "duration_canonical: got inf, must be finite"),
    ({"variables": ["p", "q"]}, 'variables: got "q", must be some of q, p, in this order, each '
     "once"),
    ({"components": ["x"]}, 'components: got "x", must be some of q, p, in this order, each once'),
    ({"variables": []}, "variables: empty, must be at least one"),
    ({"run": "a/b"}, 'run: got "a/b", must be 1 to 100 printable characters without a slash, no dot'
     " first"),
    ({"scene": ""}, 'scene: got "", must be 1 to 100 printable characters without a slash, no dot '
     "first"),
])
def test_what_does_not_fit_is_refused(change, text):
    given = {"coefficients": COEFFICIENTS, "exponents": EXPONENTS, **ROTATION, **change}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # NumPy's, of ragged rows
        with pytest.raises(hamjet.UsageError) as raised:
            hamjet.Jet.from_arrays(given.pop("coefficients"), given.pop("exponents"), **given)
    assert str(raised.value) == f"from_arrays: {text}"


@pytest.mark.parametrize("sizes, text", [
    ((0, 1), "Units: length_km: got 0, must be a number above 0"),
    ((1, np.nan), "Units: time_s: got nan, must be a number above 0"),
    ((1, -2), "Units: time_s: got -2, must be a number above 0"),
])
def test_units_are_above_0(sizes, text):
    with pytest.raises(hamjet.UsageError) as raised:
        hamjet.Units(*sizes)
    assert str(raised.value) == text
    assert hamjet.Units(length_km=7000, time_s=1000).velocity_km_s == 7
