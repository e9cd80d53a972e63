"""Jets: what they hold, evaluation, composition and inverses."""

import gc
import pickle
import warnings

import numpy as np
import pytest

import hamjet
from conftest import ORBIT, OSCILLATOR, scene


def polynomial(coefficients, exponents, points):
    """The definition: sum over k of a_k prod_j x_j**e_kj, for every point."""
    monomials = np.prod(points[:, None, :] ** exponents[None, :, :].astype(float), axis=2)
    return monomials @ coefficients.T


def deviations(count, size=1e-3, variables=6, seed=1):
    return np.random.default_rng(seed).uniform(-size, size, (count, variables))


def test_coefficients_and_exponents_have_the_documented_shapes_and_order(jet):
    assert jet.order == 3
    assert jet.variables == jet.components == ("x", "y", "z", "px", "py", "pz")
    assert jet.coefficients.shape == (6, 84) and jet.coefficients.dtype == np.float64  # C(9, 3)
    assert jet.exponents.shape == (84, 6) and jet.exponents.dtype == np.uint8
    degrees = jet.exponents.sum(axis=1)
    assert (np.diff(degrees.astype(int)) >= 0).all()
    assert (jet.exponents[1:7] == np.eye(6)).all()
    assert list(jet.exponents[7][:2]) == [2, 0] and list(jet.exponents[8][:2]) == [1, 1]
    assert (jet.coefficients[:, 0] == jet.nominal_final).all()
    assert (jet.linear_part == jet.coefficients[:, 1:7]).all()


def test_arrays_are_views_that_nobody_can_change():
    jet = hamjet.run(OSCILLATOR).runs["gauss8"].jet
    for name in ("coefficients", "exponents", "nominal_initial", "nominal_final"):
        array = getattr(jet, name)
        assert np.shares_memory(array, getattr(jet, name)), name
        assert not array.flags.writeable
        with pytest.raises(ValueError):
            array[0] = 0
        with pytest.raises(ValueError):
            array.flags.writeable = True
    with pytest.raises(AttributeError):
        jet.order = 5
    # A view keeps the jet's memory.
    coefficients = jet.coefficients
    before = coefficients.copy()
    del jet
    gc.collect()
    assert (coefficients == before).all()


def test_values_are_those_of_the_polynomial(jet):
    points = deviations(5000, 0.05)
    exact = polynomial(jet.coefficients[:, 1:], jet.exponents[1:], points)
    assert np.abs(jet.evaluate(points) - exact).max() < 1e-14 * np.abs(exact).max()
    assert (jet(points) == jet.evaluate(points)).all()
    low = jet.exponents.sum(axis=1) == 1
    linear = polynomial(jet.coefficients[:, low], jet.exponents[low], points)
    assert np.abs(jet.evaluate(points, degree=1) - linear).max() < 1e-14 * np.abs(linear).max()


def test_one_deviation_is_a_row_and_the_count_changes_nothing(jet):
    points = deviations(2000)
    values = jet.evaluate(points)
    assert jet.evaluate(points[7]).shape == (6,)
    assert (jet.evaluate(points[7]) == values[7]).all()
    for count in (0, 1, 23, 959, 960, 961, 1999):
        assert (jet.evaluate(points[:count]) == values[:count]).all()


def test_arrays_in_other_orders_and_types_are_converted(jet):
    points = deviations(100)
    values = jet.evaluate(points)
    assert (jet.evaluate(np.asfortranarray(points)) == values).all()
    assert (jet.evaluate(np.repeat(points, 2, axis=0)[::2]) == values).all()
    assert (jet.evaluate(points.astype(">f8")) == values).all()
    assert (jet.evaluate(points.tolist()) == values).all()
    integers = np.arange(12).reshape(2, 6)
    assert (jet.evaluate(integers) == jet.evaluate(integers.astype(float))).all()


def test_results_go_where_they_are_wanted(jet):
    points = deviations(2000)
    values = jet.evaluate(points)
    out = np.full((2000, 6), np.nan)
    assert jet.evaluate(points, out=out) is out
    assert (out == values).all()
    assert jet.evaluate(points, out=points) is points  # in place
    assert (points == values).all()


def test_what_does_not_fit_is_refused(jet):
    points = deviations(10)
    memory = np.zeros(200)
    read_only = np.zeros((10, 6))
    read_only.flags.writeable = False
    for call, text in (
        (lambda: jet(np.zeros((3, 5))), r"deviations: must have the shape \(N, 6\) or \(6,\), got "
                                        r"\(3, 5\)"),
        (lambda: jet(np.zeros((3, 6), dtype=complex)), "deviations: must be real numbers"),
        (lambda: jet(["1"] * 6), "deviations: must be real numbers"),
        (lambda: jet(None), "deviations: must be real numbers"),
        (lambda: jet.evaluate(points, out=np.zeros((10, 5))), r"out: must be .*\(10, 6\)"),
        (lambda: jet.evaluate(points, out=np.zeros((10, 6), np.float32)), "out: must be"),
        (lambda: jet.evaluate(points, out=np.zeros((6, 10)).T), "out: must be"),
        (lambda: jet.evaluate(points, out=read_only), "out: must be a writable"),
        (lambda: jet.evaluate(memory[:60].reshape(10, 6), out=memory[6:66].reshape(10, 6)),
         "out: shares memory"),
        (lambda: jet.evaluate(points, degree=4), "degree 4: must be 1 to the order of the jet, 3"),
        (lambda: jet.evaluate(points, degree=0), "degree 0"),
    ):
        with pytest.raises(hamjet.UsageError, match=text):
            call()


def test_what_is_not_finite_stays_in_its_row_and_is_warned_of(jet):
    points = deviations(1000)
    values = jet.evaluate(points)
    points[500, 2] = np.nan
    points[700, 0] = 1e200  # its cube is beyond binary64
    with pytest.warns(RuntimeWarning, match="12 of the values are not finite"):
        result = jet.evaluate(points)
    others = np.delete(np.arange(1000), (500, 700))
    assert (result[others] == values[others]).all()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        jet.evaluate(points[others])


def test_the_oscillators_jet_is_its_rotation():
    # Closed form: q' = p, p' = -4 q.
    jet = hamjet.run(OSCILLATOR).runs["gauss8"].jet
    t = 1.25
    matrix = np.array([[np.cos(2 * t), np.sin(2 * t) / 2], [-2 * np.sin(2 * t), np.cos(2 * t)]])
    assert np.abs(jet.linear_part - matrix).max() < 1e-14
    assert np.abs(jet.nominal_final - matrix @ [1, 0.5]).max() < 1e-14
    points = deviations(100, 1, 2)
    assert np.abs(jet(points) - points @ matrix.T).max() < 1e-13


def test_keplers_jet_is_the_closed_form():
    # mu = 1, start (1, 0), velocity (0, 1 + d), after 2 pi: a period of a^(3/2), by hand.
    result = hamjet.run({
        "schema": 1, "title": "Kepler", "system": {"model": "kepler", "mu_km3_s2": 1},
        "nominal": {"position_km": [1, 0, 0], "velocity_km_s": [0, 1, 0]},
        "jet": {"order": 3, "variables": ["py"], "duration_canonical": 2 * np.pi},
        "integrator": [{"label": "gauss8", "method": "gauss", "stages": 8, "tolerance": 1e-15}]})
    jet = result.runs["gauss8"].jet
    pi = np.pi
    assert jet.components == ("x", "y", "px", "py")  # z stays zero, and is not computed
    assert np.abs(jet.coefficients[0] - [1, 0, -18 * pi**2, -108 * pi**2]).max() < 1e-9
    assert np.abs(jet.coefficients[1] - [0, -6 * pi, -24 * pi, 36 * pi**3 - 68 * pi]).max() < 1e-9


def test_a_jet_and_its_inverse_are_the_identity(jet):
    inverse = jet.inverse()
    assert inverse.duration_canonical == -5
    assert (jet.start_canonical, inverse.start_canonical) == (0, 5)
    assert inverse.inverse().start_canonical == 0
    assert pickle.loads(pickle.dumps(inverse)).start_canonical == 5
    assert (inverse.nominal_initial == jet.nominal_final).all()
    assert (inverse.nominal_final == jet.nominal_initial).all()
    assert (inverse.coefficients[:, 0] == jet.nominal_initial).all()
    for first, second in ((jet, inverse), (inverse, jet)):
        identity = first.compose(second)
        assert (identity.nominal_final == first.nominal_initial).all()
        assert (identity.coefficients[:, 0] == first.nominal_initial).all()
        assert identity.duration_canonical == 0
        # Relative to the terms that cancel.
        expected = np.zeros((6, 84))
        expected[:, 1:7] = np.eye(6)
        expected[:, 0] = first.nominal_initial
        degrees = jet.exponents.sum(axis=1)
        for degree in range(1, 4):
            miss = np.abs(identity.coefficients - expected)[:, degrees == degree].max()
            size = max(np.abs(first.coefficients[:, degrees == d]).max()
                       * np.abs(second.coefficients[:, degrees == e]).max()
                       for d in range(1, degree + 1) for e in range(1, degree + 1))
            assert miss < 1e-12 * size, degree


@pytest.mark.parametrize("revolutions", [0.25, 1, 4, 10])
def test_what_an_inverse_loses_is_the_condition_number_for_each_degree(revolutions):
    jet = hamjet.run(hamjet.orbit(a_km=7078, e=0.01, i_deg=98, J2=1e-3, order=4,
                                  duration_orbits=revolutions)).runs["gauss8"].jet
    condition = np.linalg.cond(jet.linear_part)
    degrees = jet.exponents.sum(axis=1)
    expected = np.zeros_like(jet.coefficients)
    expected[:, 1:7] = np.eye(6)
    miss = np.abs((jet.inverse() @ jet).coefficients - expected)
    for degree in range(1, 5):
        # About: the sums that rounding enters have tens of terms.
        assert miss[:, degrees == degree].max() < 1e-14 * condition**degree


def test_two_halves_composed_are_the_whole(jet):
    # The flow's identity, to the integrator's tolerance.
    half = {"order": 3, "duration_canonical": 2.5}
    first = hamjet.run(scene(ORBIT, jet=half)).runs["gauss8"].jet
    unit = first.units
    state = first.nominal_final
    second = hamjet.run(scene(
        ORBIT, jet=half, units={"length_km": unit.length_km},
        nominal={"position_km": state[:3] * unit.length_km,
                 "velocity_km_s": state[3:] * unit.velocity_km_s})).runs["gauss8"].jet
    whole = first.compose(second)
    assert whole.duration_canonical == 5
    degrees = jet.exponents.sum(axis=1)
    for degree in range(4):
        of_degree = degrees == degree
        size = np.abs(jet.coefficients[:, of_degree]).max()
        error = np.abs(whole.coefficients - jet.coefficients)[:, of_degree].max() / size
        assert error < 1e-11, degree


def test_the_order_of_a_composition_is_the_lower_one(jet):
    linear = hamjet.run(ORBIT, overrides={"jet.order": 1}).runs["gauss8"].jet
    for first, second in ((jet.inverse(), linear), (linear.inverse(), jet)):
        # The nominals of the two orders are the same numbers.
        assert first.compose(second).order == 1


def test_jets_that_do_not_follow_each_other_are_refused(jet):
    oscillator = hamjet.run(OSCILLATOR).runs["gauss8"].jet
    momenta = hamjet.run(ORBIT, overrides={"jet.variables": ["px", "py", "pz"]}).runs["gauss8"].jet
    for call, text in (
        (lambda: jet.compose(oscillator), "compose: the jets are of different systems"),
        (lambda: jet.compose(jet), "compose: the second jet starts .* from where the first ends"),
        (lambda: jet.compose(momenta), "compose: the second jet is expanded in px py pz, must be"),
        (lambda: momenta.inverse(), "inverse: the jet is expanded in px py pz, must be in all"),
        (lambda: momenta.invert_partially("F1"), "partial inversion: the jet must be expanded"),
    ):
        with pytest.raises(hamjet.UsageError, match=text):
            call()


def test_a_jet_in_some_variables_composes_with_one_in_all(jet):
    momenta = hamjet.run(ORBIT, overrides={"jet.variables": ["px", "py", "pz"]}).runs["gauss8"].jet
    back = momenta.compose(jet.inverse())
    assert back.variables == ("px", "py", "pz")
    expected = np.vstack([np.zeros((3, 3)), np.eye(3)])
    assert np.abs(back.linear_part - expected).max() < 1e-11


def test_symplecticity_tells_the_methods_apart(jet):
    defects = jet.symplecticity()
    assert list(defects["degree"]) == [0, 1, 2]
    assert defects["scaled"].max() < 1e-14
    loose = hamjet.run(scene(ORBIT, integrator=[
        {"label": "fehlberg78", "method": "fehlberg78", "tolerance": 1e-6}])).runs["fehlberg78"].jet
    assert loose.symplecticity()["scaled"].min() > 1e-12


def test_jets_in_extended_precision_keep_their_digits():
    precise = {"precision": "extended", "integrator.gauss8.tolerance": 1e-28}
    jet = hamjet.run(OSCILLATOR, overrides=precise).runs["gauss8"].jet
    assert jet.precision == "extended"
    # A rotation by 2.5: rounding it to double would leave 1e-17 of the brackets.
    assert jet.symplecticity()["scaled"].max() < 1e-30
    assert jet.inverse().compose(jet).precision == "extended"


def test_the_jacobian_is_the_derivative_of_the_polynomial(jet):
    points = deviations(40, 0.02)
    found = jet.jacobian(points)
    assert found.shape == (40, 6, 6)
    for j in range(6):
        # The derivative of each monomial, from its exponents.
        lower = jet.exponents.astype(int) - np.eye(6, dtype=int)[j]
        kept = lower[:, j] >= 0
        slope = polynomial(jet.coefficients[:, kept] * jet.exponents[kept, j], lower[kept], points)
        assert np.abs(found[:, :, j] - slope).max() < 1e-13 * np.abs(slope).max()
    assert (jet.jacobian(np.zeros(6)) == jet.linear_part).all()
    assert (jet.jacobian(points[3]) == found[3]).all()


def test_the_jacobian_of_a_linear_jet_is_its_linear_part_everywhere():
    linear = hamjet.run(scene(ORBIT, jet={"order": 1, "duration_canonical": 1.0,
                                          "variables": ["x", "px"]})).runs["gauss8"].jet
    found = linear.jacobian([[0.1, 0.2], [0, 0]])
    assert found.shape == (2, len(linear.components), 2)
    assert (found == linear.linear_part).all()
    with pytest.raises(hamjet.UsageError, match=r"^deviations: must have the shape \(N, 2\)"):
        linear.jacobian(np.zeros(6))


def test_the_product_of_jets_is_composition_as_of_their_matrices():
    halves = [hamjet.run(ORBIT, overrides={"jet.duration_canonical": 1.0}).runs["gauss8"].jet]
    position, velocity = np.split(halves[0].nominal_final, 2)
    units = halves[0].units
    halves.append(hamjet.run(scene(ORBIT, units={"length_km": units.length_km}, nominal={
        "position_km": position * units.length_km, "velocity_km_s": velocity * units.velocity_km_s},
        jet={"order": 3, "duration_canonical": 1.0})).runs["gauss8"].jet)
    first, second = halves
    product = second @ first
    assert (product.coefficients == first.compose(second).coefficients).all()
    assert product.duration_canonical == 2.0
    largest = np.abs(product.linear_part).max()
    assert np.abs(product.linear_part - second.linear_part @ first.linear_part).max() < (
        1e-14 * largest)
    # The whole flow in one.
    whole = hamjet.run(ORBIT, overrides={"jet.duration_canonical": 2.0}).runs["gauss8"].jet
    assert np.abs(product.linear_part - whole.linear_part).max() < 1e-11 * largest


def test_products_that_do_not_fit_are_refused(jet):
    oscillator = hamjet.run(OSCILLATOR).runs["gauss8"].jet
    with pytest.raises(hamjet.UsageError, match="^compose: the jets are of different systems"):
        oscillator @ jet
    with pytest.raises(hamjet.UsageError, match="^compose: the second jet starts"):
        jet @ jet
    other = hamjet.run(ORBIT, overrides={"units.length_km": 6000}).runs["gauss8"].jet
    with pytest.raises(hamjet.UsageError, match="^compose: the jets have different canonical"):
        other @ jet
    part = hamjet.run(ORBIT, overrides={"jet.variables": ["x"]}).runs["gauss8"].jet
    with pytest.raises(hamjet.UsageError, match="^compose: the second jet is expanded in x, must"):
        part @ jet
    for wrong in (3, None, "jet"):
        with pytest.raises(TypeError, match="unsupported operand"):
            jet @ wrong
    with pytest.raises(TypeError):
        jet.compose(None)


def dated(epoch, **changes):
    settings = {"epoch": epoch, "time_system": "UTC", "reference_frame": "TOD",
                "center_name": "EARTH", **changes}
    return hamjet.run(scene(ORBIT, ephemeris=settings)).runs["gauss8"].jet


def test_jets_with_dates_follow_each_other_in_time(jet):
    first = dated("2026-03-01T00:00:00")
    back = first.inverse()
    # The flow back starts at the time at which the flow ends, and ends at the time at which it
    # starts.
    assert (back @ first).linear_part.shape == (6, 6)
    assert (first @ back).duration_canonical == 0
    end = np.datetime64("2026-03-01T00:00:00", "ns") + np.timedelta64(
        round(first.duration_s * 1e9), "ns")
    later = dated("2026-03-02T00:00:00")
    with pytest.raises(hamjet.UsageError) as raised:
        later.inverse() @ first
    start = end + np.timedelta64(1, "D")
    said = [part.rstrip(",") for part in str(raised.value).split() if part.startswith("2026-")]
    assert str(raised.value).startswith("compose: the second jet starts at 2026-03-02T")
    for found, expected in zip(said, (start, end)):
        assert abs(np.datetime64(found[:-3], "ns") - expected) <= np.timedelta64(10, "ns")
    with pytest.raises(hamjet.UsageError) as raised:
        back @ dated("2026-03-01T00:00:00", time_system="TDB")
    assert str(raised.value) == ("compose: the second jet is in TOD about EARTH in UTC, must be in "
                                 "the frame of the first, TOD about EARTH in TDB")
    # Without a date there is nothing to compare.
    assert (back @ jet).order == first.order
