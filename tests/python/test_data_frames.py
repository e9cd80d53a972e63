"""Points with names: columns go by name in any order, never by position."""

import numpy as np
import pytest

import hamjet

STATE = ("x", "y", "z", "px", "py", "pz")
RTN = ("R_m", "T_m", "N_m", "vR_m_s", "vT_m_s", "vN_m_s")
INERTIAL = ("x_m", "y_m", "z_m", "vx_m_s", "vy_m_s", "vz_m_s")


class Row:
    """What a pandas.Series is to hamjet: numbers with an index."""

    def __init__(self, index, numbers):
        self.index = list(index)
        self._numbers = np.asarray(numbers)

    def __getitem__(self, labels):
        return Row(labels, [self._numbers[self.index.index(label)] for label in labels])

    def __array__(self, *_, **__):
        return self._numbers


class Frame:
    """What a pandas.DataFrame is to hamjet: columns by name."""

    def __init__(self, columns, rows):
        self.columns = list(columns)
        self.index = range(len(rows))
        self._rows = np.asarray(rows)

    def __getitem__(self, labels):
        return Frame(labels, self._rows[:, [self.columns.index(label) for label in labels]])

    def __array__(self, *_, **__):
        return self._rows


def makers():
    """The stand-ins, and pandas itself where it is installed."""
    yield Frame, Row
    try:
        import pandas
    except ImportError:
        return
    yield (lambda columns, rows: pandas.DataFrame(rows, columns=columns),
           lambda index, numbers: pandas.Series(numbers, index=index))


@pytest.fixture(params=makers(), ids=lambda maker: "stand-in" if maker[0] is Frame else "pandas")
def kinds(request):
    return request.param


ORDERS = ([0, 1, 2, 3, 4, 5], [5, 4, 3, 2, 1, 0], [3, 0, 4, 1, 5, 2])


def expect_by_name(kinds, call, names, points):
    frame, row = kinds
    expected = np.asarray(call(points))
    for order in ORDERS:
        columns = [names[i] for i in order]
        assert (np.asarray(call(frame(columns, points[:, order]))) == expected).all(), columns
        one = np.asarray(call(row(columns, points[1, order])))
        assert (one == expected[1]).all(), columns


def test_columns_go_by_name(kinds, jet):
    points = np.random.default_rng(2).uniform(-1e-3, 1e-3, (20, 6))
    expect_by_name(kinds, jet.evaluate, STATE, points)
    expect_by_name(kinds, jet, STATE, points)
    expect_by_name(kinds, lambda d: jet.evaluate(d, degree=1), STATE, points)
    function = jet.invert_partially("F1")
    for call in (function.evaluate, function.gradient, function.remaining):
        expect_by_name(kinds, call, function.variables, points)


def test_relative_states_go_by_the_names_of_their_frame(kinds, jet):
    points = np.random.default_rng(2).uniform(-1e2, 1e2, (20, 6)) * ([1] * 3 + [1e-3] * 3)
    for names, options in ((RTN, {}), (RTN, {"derivatives": "inertial"}),
                           (INERTIAL, {"frame": "inertial"})):
        def call(states, options=options):
            states = jet.evaluate_relative(states, **options).states
            return states if len(states) > 1 else states[0]
        expect_by_name(kinds, call, names, points)


def test_other_names_are_refused_with_those_expected(kinds, jet):
    frame, row = kinds
    points = np.zeros((2, 6))
    right = "the columns must be x, y, z, px, py, pz, in any order, got "
    for columns in (("x", "y", "z", "px", "py", "vz"), ("x", "x", "z", "px", "py", "pz"),
                    range(6), RTN):
        with pytest.raises(hamjet.UsageError) as raised:
            jet.evaluate(frame(columns, points))
        assert str(raised.value).startswith(f"deviations: {right}{list(columns)[0]!r}, "), columns
        with pytest.raises(hamjet.UsageError, match=f"^deviations: {right}"):
            jet(row(columns, points[0]))
    for columns in (STATE[:5], (*STATE, "t")):
        with pytest.raises(hamjet.UsageError, match=f"^deviations: {right}"):
            jet.evaluate(frame(columns, np.zeros((2, len(columns)))))
    with pytest.raises(hamjet.UsageError, match="^states: the columns must be R_m, T_m, N_m"):
        jet.evaluate_relative(frame(STATE, points))
    with pytest.raises(hamjet.UsageError, match="^states: the columns must be x_m, y_m, z_m"):
        jet.evaluate_relative(frame(RTN, points), frame="inertial")
    with pytest.raises(hamjet.UsageError, match="LVLH"):
        jet.evaluate_relative(frame(RTN, points), frame="LVLH")
    with pytest.raises(hamjet.UsageError, match="^w: the columns must be x, y, z, x0, y0, z0"):
        jet.invert_partially("F1").gradient(frame(STATE, points))
    with pytest.raises(hamjet.UsageError, match="^deviations: a list of rows with labels"):
        jet([row(STATE, points[0]), row(STATE, points[1])])


def test_names_do_not_bring_other_numbers_in(kinds, jet):
    frame, _ = kinds
    with pytest.raises(hamjet.UsageError, match="^deviations: must be real numbers"):
        jet.evaluate(frame(STATE, np.zeros((2, 6), dtype=complex)))
    with pytest.raises(hamjet.UsageError, match="^out: must be a writable float64 array"):
        jet.evaluate(np.zeros((2, 6)), out=frame(STATE, np.zeros((2, 6))))
