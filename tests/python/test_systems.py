"""Systems of one's own: functions that are traced, text, and SymPy's expressions."""

import math
import pickle

import numpy as np
import pytest

import hamjet

MU = 1 / 82.30059


def three_bodies(q, p, mu):
    to_earth = np.sqrt((q[0] + mu)**2 + q[1]**2 + q[2]**2)
    to_moon = np.sqrt((q[0] - 1 + mu)**2 + q[1]**2 + q[2]**2)
    return p @ p / 2 + q[1] * p[0] - q[0] * p[1] - (1 - mu) / to_earth - mu / to_moon


def test_a_traced_function_is_the_same_system_as_its_text():
    traced = hamjet.system(three_bodies, coordinates="x y z", parameters={"mu": MU})
    assert traced.momenta == ("px", "py", "pz")
    written = hamjet.system(
        "(px^2 + py^2 + pz^2)/2 + y*px - x*py - (1 - mu)/sqrt((x + mu)^2 + y^2 + z^2)"
        " - mu/sqrt((x - 1 + mu)^2 + y^2 + z^2)", coordinates=["x", "y", "z"],
        parameters={"mu": MU})
    # The published 9:2 near-rectilinear halo orbit, which closes after 1.5111...
    start = {"x": 1.0220215127358174, "z": -0.1820967615242405, "py": 0.9187651716730236}
    jets = []
    for system in (traced, written):
        scene = system.scene(start, duration=1.5111111111111111, order=2)
        jets.append(hamjet.run(scene).runs["gauss8"].jet)
        assert jets[-1].nominal_final == pytest.approx(jets[-1].nominal_initial, abs=1e-10)
        assert jets[-1].variables == ("x", "y", "z", "px", "py", "pz")
    scale = np.abs(jets[0].coefficients).max()
    assert np.abs(jets[0].coefficients - jets[1].coefficients).max() < 1e-9 * scale


def test_sympy_gives_the_same_system():
    sympy = pytest.importorskip("sympy")
    q, p = sympy.symbols("q p")
    made = hamjet.system(p**2 / 2 - sympy.cos(q) + sympy.Rational(1, 3) * sympy.exp(-q**2) + 0.1 * q,
                         coordinates="q")
    text = hamjet.system("p^2/2 - cos(q) + exp(-q^2)/3 + 0.1*q", coordinates="q")
    ends = [hamjet.run(s.scene([1.0, 0.2], duration=2, order=3)).runs["gauss8"].jet.coefficients
            for s in (made, text)]
    assert ends[0] == pytest.approx(ends[1], abs=1e-12)


def test_a_pendulum_has_its_generating_function_and_its_pickle():
    system = hamjet.system(lambda q, p: p**2 / 2 - np.cos(q), coordinates="q")
    assert (system.coordinates, system.momenta) == (("q",), ("p",))
    again = pickle.loads(pickle.dumps(system))
    assert again == system
    scene = again.scene([1.5, 0], duration=2, order=4,
                        tables={"generating_function": {"kinds": ["F1"]}})
    run = hamjet.run(scene).runs["gauss8"]
    jet = pickle.loads(pickle.dumps(run.jet))
    assert jet.variables == ("q", "p")
    assert np.linalg.det(jet.linear_part) == pytest.approx(1, abs=1e-12)
    # The generating function's gradient gives back the jet, degree by degree.
    assert jet.invert_partially("F1").exactness["scaled"].max() < 1e-12


def test_an_oscillator_has_moments_and_events():
    system = hamjet.system(lambda q, p: (p**2 + q**2) / 2, coordinates="q")
    tables = {"uncertainty": {"position_m": [0.3], "velocity_m_s": [0.4], "samples": 50}}
    moments = hamjet.uncertainty(system.scene({"q": 1}, duration=2, order=2, tables=tables))
    s = np.array([0.3, 0.4])
    turn = np.array([[math.cos(2), math.sin(2)], [-math.sin(2), math.cos(2)]])
    assert moments.cartesian.standard_deviation[0, 0, -1] == pytest.approx(
        np.sqrt(turn**2 @ s**2), abs=1e-12)
    assert moments.flown_states(0, 0).shape == (50, 2)
    tables = {"event": {"surface": "expression", "expression": "q - 0.5"}}
    event = hamjet.event(system.scene({"q": 1}, duration=2, order=8, tables=tables))
    # (1 + dq) cos t + dp sin t = 1/2, of the amplitude A: t = acos(1/(2 A)) + atan2(dp, 1 + dq).
    dq, dp = 0.02, -0.03
    time = math.acos(0.5 / math.hypot(1 + dq, dp)) + math.atan2(dp, 1 + dq)
    told = event.evaluate([dq, dp])
    assert told[0] == pytest.approx(time, abs=1e-11)
    assert told[1] == pytest.approx(0.5, abs=1e-11)
    with pytest.raises(hamjet.UsageError, match="2 numbers a row"):
        event.evaluate([0, 0, 0])


def test_a_vector_field_is_that_of_a_damped_oscillator():
    system = hamjet.system(vector_field=lambda x, c: [x[1], -x[0] - 2 * c * x[1]], states="u v",
                           parameters={"c": 0.1})
    jet = hamjet.run(system.scene({"u": 1}, duration=3, order=1)).runs["gauss8"].jet
    w = math.sqrt(0.99)
    assert jet.nominal_final[0] == pytest.approx(
        math.exp(-0.3) * (math.cos(3 * w) + 0.1 / w * math.sin(3 * w)), abs=1e-11)
    assert jet.variables == ("u", "v")
    other = system.scene({"u": 1}, duration=3, order=1, parameters={"c": 0})
    end = hamjet.run(other).runs["gauss8"].jet.nominal_final
    assert end[0] == pytest.approx(math.cos(3), abs=1e-11)


def test_parameters_are_variables(tmp_path):
    """A particle on a spring: q = cos(w t) + sin(w t)/w with w = sqrt(k), from q = p = 1."""
    system = hamjet.system("p^2/2 + k*q^2/2", coordinates="q", parameters={"k": 2.25})
    scene = system.scene([1, 1], duration=2, order=3, variables=["q", "p", "k"])
    jet = hamjet.run(scene).runs["gauss8"].jet
    assert jet.variables == jet.components == ("q", "p", "k")
    # The series of q in dk by that of w, to degree 3.
    w = np.poly1d([1.5**-5 / 16, -1.5**-3 / 8, 1 / 3, 1.5])
    t, d = 2, w - 1.5
    steps = [np.poly1d([1]), d * t, d**2 * t**2 / 2, d**3 * t**3 / 6]
    cos, sin = math.cos(1.5 * t), math.sin(1.5 * t)
    of_cos = sum(c * s for c, s in zip((cos, -sin, -cos, sin), steps))
    of_sin = sum(c * s for c, s in zip((sin, cos, -sin, -cos), steps))
    inverse = sum((-1)**n * d**n / 1.5**(n + 1) for n in range(1, 4)) + 1 / 1.5
    right = (of_cos + of_sin * inverse).coef[::-1]
    exponents = jet.exponents.tolist()
    for degree in range(4):
        found = jet.coefficients[0][exponents.index([0, 0, degree])]
        assert found == pytest.approx(right[degree], abs=1e-11)
    again = pickle.loads(pickle.dumps(jet))
    assert again.variables == jet.variables
    built = hamjet.Jet.from_arrays(
        jet.coefficients, jet.exponents, nominal_initial=jet.nominal_initial,
        duration_canonical=jet.duration_canonical, units=jet.units, model="own",
        state_parameters=["k"])
    assert built.variables == ("q", "p", "k")
    assert (built.evaluate([[0.1, 0, 0.2]]) == jet.evaluate([[0.1, 0, 0.2]])).all()
    assert (jet.inverse() @ jet).linear_part == pytest.approx(np.eye(3), abs=1e-12)
    for refused in (jet.symplecticity, lambda: jet.invert_partially("F1")):
        with pytest.raises(hamjet.UsageError, match="parameters|ends with k"):
            refused()
    with pytest.raises(hamjet.UsageError, match="state_parameters: got"):
        hamjet.Jet.from_arrays(
            jet.coefficients, jet.exponents, nominal_initial=jet.nominal_initial,
            duration_canonical=2, units=jet.units, model="own", state_parameters=["q"])


@pytest.mark.parametrize("function, words", [
    (lambda q, p: p if q > 0 else -p, "a branch depends on a symbol"),
    (lambda q, p: p if q == 0 else -p, "a branch depends on a symbol"),
    (lambda q, p: q and p, "a branch depends on a symbol"),
    (lambda q, p: max(q, p), "a branch depends on a symbol"),
    (lambda q, p: np.maximum(q, p), "numpy.maximum of a symbol"),
    (lambda q, p: np.where(q > 0, q, p), "a branch depends on a symbol"),
    (lambda q, p: math.sin(q), "numpy.sin"),
    (lambda q, p: float(q), "has no value yet"),
    (lambda q, p: abs(q), "abs has no Taylor series"),
    (lambda q, p: np.abs(q), "numpy.absolute has no Taylor series"),
    (lambda q, p: q % 2, "a remainder"),
    (lambda q, p: q // 2, "a remainder"),
    (lambda q, p: 1j * q, "a complex number"),
    (lambda q, p: q + math.nan, "no finite number"),
    (lambda q, p: None, "returned None"),
    (lambda q, p: [q, p], "2 expressions, must be 1"),
    (lambda q, r: q, "an argument r, must be one of"),
    (lambda q, p: "text" * q, "wrong type, got str"),
    (lambda q, p: p[0]**2 / 2 + q[0]**2, "one variable is used as a vector"),
    (lambda q: sum(x**2 for x in q), "one variable is used as a vector"),
])
def test_what_cannot_be_traced_is_said(function, words):
    with pytest.raises(hamjet.UsageError, match=words):
        hamjet.system(function, coordinates="q")


@pytest.mark.parametrize("arguments, words", [
    ({"hamiltonian": "p^2/2 - cos q", "coordinates": "q"},
     "system.hamiltonian: a function without parentheses, got \"q\" at column 13"),
    ({"hamiltonian": "p^2/2 + a*q", "coordinates": "q"}, "unknown name, got \"a\""),
    ({"hamiltonian": "p^2/2", "coordinates": "q", "momenta": "p s"}, "system.momenta: .* must be 1"),
    ({"hamiltonian": "p^2/0", "coordinates": "q"}, "division by zero"),
    ({"vector_field": {"x": "v", "v": "y"}, "states": "x v"}, "system.vector_field.v: unknown name"),
])
def test_mistakes_in_texts_are_said_with_their_place(arguments, words):
    with pytest.raises(hamjet.SceneError, match=words):
        hamjet.system(**arguments)


def test_numpy_works_on_arrays_of_symbols():
    def h(z):
        q, p = z[:2], z[2:]
        rotation = np.array([[0.6, -0.8], [0.8, 0.6]])
        turned = rotation @ q
        return np.dot(p, p) / 2 + np.sum(np.exp(-turned**2)) + np.hypot(q[0], 2) + np.arctan2(q[1], 3)
    system = hamjet.system(h, coordinates="x y")
    scene = system.scene([0.3, 0.2, 0.1, 0], duration=0.5, order=1)
    jet = hamjet.run(scene).runs["gauss8"].jet
    # The energy, by plain numbers.
    start, end = np.asarray(jet.nominal_initial), np.asarray(jet.nominal_final)
    assert h(end) == pytest.approx(h(start), abs=1e-12)
