"""Flights of the attack: states in SI units, in the long double of the machine."""
import ctypes
import os

import numpy as np

REAL = np.longdouble
TOLERANCE = REAL(2) ** -57  # of a step, near what rounding in extrapolation leaves
PAIR_TOLERANCE = REAL(1e-13)  # of thousands of pairs, whose separations are wanted to a millionth


def _library():
    library = ctypes.CDLL(os.environ["HAMJET_ATTACK_FLIGHTS"])
    whole, pointer = ctypes.c_int, ctypes.c_void_p
    field = [pointer, whole, pointer, pointer, pointer]
    library.fly.argtypes = [whole, pointer, *field, whole, pointer, pointer, pointer]
    library.least_separations.argtypes = [whole, pointer, pointer, *field[:-1], pointer, pointer,
                                          pointer, whole, pointer, pointer, pointer]
    library.make_earth.argtypes = [whole, pointer, pointer, pointer, pointer, whole, pointer, whole,
                                   whole, whole, pointer]
    library.make_earth.restype = pointer
    library.delete_earth.argtypes = [pointer]
    library.light_chief.argtypes = [pointer, pointer, pointer]
    library.share_light.argtypes = [pointer, pointer]
    library.axes_of_earth.argtypes = [pointer, whole, pointer, pointer]
    library.tai_minus_utc.argtypes = [whole, whole, whole, pointer]
    library.tai_minus_utc.restype = ctypes.c_double
    return library


def address(numbers):
    return numbers.ctypes.data


LIBRARY = _library()


class FlightFailed(Exception):
    """A flight that comes too near to the centre."""


class Field:
    """A centre with zonal harmonics: mu in m^3/s^2, the radius in m, J_n at index n. Starts of its
    flights may have a time, `begin`, from which times are counted; for this field it is nothing."""

    _earth = None

    def __init__(self, mu, radius=0, zonals=()):
        self.mu, self.radius = REAL(mu), REAL(radius)
        self.zonals = np.array(list(zonals) or [0], dtype=REAL)
        self._centre = np.array([self.mu, self.radius], dtype=REAL)

    def _arguments(self, begin):
        return (address(self._centre), len(self.zonals) - 1, address(self.zonals), self._earth,
                address(begin))

    def fly(self, starts, times, tolerance=TOLERANCE, begin=0):
        """States [..., time, 6] of starts [..., 6] at times that move away from 0 (0 may be the
        first)."""
        begin = np.array([begin], dtype=REAL)
        starts = np.ascontiguousarray(starts, dtype=REAL)
        times = np.ascontiguousarray(np.atleast_1d(times), dtype=REAL)
        many = starts.reshape(-1, 6)
        out = np.empty((len(many), len(times), 6), dtype=REAL)
        tolerance = np.array([tolerance], dtype=REAL)
        if LIBRARY.fly(len(many), address(many), *self._arguments(begin), len(times),
                       address(times), address(tolerance), address(out)):
            raise FlightFailed()
        return out.reshape(starts.shape[:-1] + (len(times), 6))

    def to(self, starts, time, tolerance=TOLERANCE, begin=0):
        """States at one time, 0 included."""
        return self.fly(starts, [time], tolerance, begin)[..., 0, :]

    def least_separations(self, first, second, start, end, looks=9, tolerance=PAIR_TOLERANCE,
                          of_second=None):
        """Least separations of pairs within times after their states, and when. The second ones fly
        in a field of their own, if there is one."""
        first = np.ascontiguousarray(np.broadcast_to(first, np.shape(second)), dtype=REAL)
        second = np.ascontiguousarray(second, dtype=REAL)
        count = second.reshape(-1, 6).shape[0]
        separations, times = np.empty(count, dtype=REAL), np.empty(count, dtype=REAL)
        window, tolerance = np.array([start, end], dtype=REAL), np.array([tolerance], dtype=REAL)
        begin = np.zeros(1, dtype=REAL)
        *field, start_of_clock = self._arguments(begin)
        other = (of_second or self)._earth
        if LIBRARY.least_separations(count, address(first), address(second), *field, other, start_of_clock,
                                     address(window), looks,
                                     address(tolerance), address(separations), address(times)):
            raise FlightFailed()
        return separations, times

    def energy(self, state):
        """The energy in the field of the point mass alone."""
        return np.dot(state[3:], state[3:]) / 2 - self.mu / np.sqrt(np.dot(state[:3], state[:3]))

    def period(self, state):
        """The period of the osculating ellipse."""
        a = -self.mu / (2 * self.energy(state))
        return 2 * PI * np.sqrt(a * a * a / self.mu)

    def transition(self, start, time):
        """d state(time) / d start by differences of the fourth order, of one time or many. Their
        steps are a share of what the flow stretches them to."""
        r = np.sqrt(np.dot(start[:3], start[:3]))
        scale = np.array([1] * 3 + [np.sqrt(self.mu / r ** 3)] * 3, dtype=REAL)
        times = np.atleast_1d(time)

        def slopes(h):
            change = np.diag(h * scale)
            ends = self.fly(np.array([start + k * change for k in (1, -1, 2, -2)]), times)
            found = (8 * (ends[0] - ends[1]) - (ends[2] - ends[3])) / (
                12 * h * scale[:, None, None])
            return np.moveaxis(found, 0, -1)

        rough = slopes(r * REAL(1e-7)) / scale[:, None] * scale
        matrix = slopes(r * REAL(3e-4) / np.max(np.abs(rough)))
        return matrix if np.ndim(time) else matrix[0]


PI = REAL("3.14159265358979323846264338327950288")


def coast_times(field, state, duration, parts):
    """Times from 0 to the duration whose looks are about equal in true anomaly: `parts` a radian of
    a circle at the place where the orbit then is."""
    sign = -1 if duration < 0 else 1
    times, now, state = [REAL(0)], REAL(0), np.array(state, dtype=REAL)
    while abs(now) < abs(duration):
        r = np.sqrt(np.dot(state[:3], state[:3]))
        step = sign * np.sqrt(r ** 3 / field.mu) / parts
        # A step never grows past what the orbit would have at its lowest on the way.
        following = now + step
        if (duration - following) * sign < abs(step) * REAL(0.01):
            following = REAL(duration)
        state = field.to(state, following - now, REAL(1e-10), begin=now)
        now = following
        times.append(now)
    return np.array(times)
