"""Forms of a deputy's state, in 64 bits of mantissa: the program that the module is compared with.

It shares nothing with the module: classical elements by node and perigee, Kepler's equation by
bisection and Newton's method, curvilinear coordinates by the angles of a sphere. Metres, seconds.
"""

from __future__ import annotations

import dataclasses

import numpy as np

Real = np.longdouble
PI = Real("3.14159265358979323846264338327950288")
DEGREE = PI / 180

FORMS = ("RTN", "RTN inertial", "inertial", "curvilinear", "relative-elements",
         "element-differences")


def real(values: object) -> np.ndarray:
    return np.array(values, dtype=Real)


def turn(axis: int, angle: Real) -> np.ndarray:
    """The matrix that takes components along axes turned by an angle to those along the old."""
    c, s = np.cos(angle), np.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    matrix = real(np.eye(3))
    matrix[i, i] = matrix[j, j] = c
    matrix[i, j], matrix[j, i] = -s, s
    return matrix


@dataclasses.dataclass
class Elements:
    """a, e, then inclination, node, argument of perigee and mean anomaly in radians."""

    a: Real
    e: Real
    i: Real
    node: Real
    perigee: Real
    mean: Real

    def true_anomaly(self) -> Real:
        mean = np.remainder(self.mean + PI, 2 * PI) - PI
        low, high = -PI, PI
        for _ in range(12):
            E = (low + high) / 2
            low, high = (E, high) if E - self.e * np.sin(E) < mean else (low, E)
        for _ in range(8):
            E -= (E - self.e * np.sin(E) - mean) / (1 - self.e * np.cos(E))
        return 2 * np.arctan2(np.sqrt(1 + self.e) * np.sin(E / 2),
                              np.sqrt(1 - self.e) * np.cos(E / 2))

    def state(self, mu: Real) -> tuple[np.ndarray, np.ndarray]:
        p, f = self.a * (1 - self.e**2), self.true_anomaly()
        axes = turn(2, self.node) @ turn(0, self.i) @ turn(2, self.perigee)
        zero = Real(0)
        place = real([np.cos(f), np.sin(f), zero]) * p / (1 + self.e * np.cos(f))
        return axes @ place, axes @ real([-np.sin(f), self.e + np.cos(f), zero]) * np.sqrt(mu / p)


def mean_of_true(e: Real, f: Real) -> Real:
    E = 2 * np.arctan2(np.sqrt(1 - e) * np.sin(f / 2), np.sqrt(1 + e) * np.cos(f / 2))
    return E - e * np.sin(E)


def elements_of(r: np.ndarray, v: np.ndarray, mu: Real) -> Elements:
    h = np.cross(r, v)
    distance = np.sqrt(r @ r)
    eccentricity = np.cross(v, h) / mu - r / distance
    e = np.sqrt(eccentricity @ eccentricity)
    node = real([-h[1], h[0], 0]) / np.hypot(h[0], h[1])
    beyond = np.cross(h, node) / np.sqrt(h @ h)
    perigee = np.arctan2(eccentricity @ beyond, eccentricity @ node)
    latitude = np.arctan2(r @ beyond, r @ node)
    return Elements(1 / (2 / distance - v @ v / mu), e, np.arctan2(np.hypot(h[0], h[1]), h[2]),
                    np.arctan2(h[0], -h[1]), perigee, mean_of_true(e, latitude - perigee))


def wrapped(angle: Real) -> Real:
    return np.remainder(angle + PI, 2 * PI) - PI


class Chief:
    """Converts states of deputies beside it."""

    def __init__(self, r: np.ndarray, v: np.ndarray, mu: float) -> None:
        self.r, self.v, self.mu = r, v, Real(mu)
        self.h = np.cross(r, v)
        self.distance = np.sqrt(r @ r)
        self.momentum = np.sqrt(self.h @ self.h)
        normal = self.h / self.momentum
        radial = r / self.distance
        self.axes = real([radial, np.cross(normal, radial), normal])
        self.rate = self.momentum / self.distance**2
        self.omega = real([0, 0, self.rate])
        self.elements = elements_of(r, v, self.mu)

    def deputy(self, form: str, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The inertial state of the deputy that six numbers of a form tell."""
        x = real(x)
        if form == "inertial":
            return self.r + x[:3], self.v + x[3:]
        if form.startswith("RTN"):
            seen = 0 if form == "RTN inertial" else np.cross(self.omega, x[:3])
            return self.r + self.axes.T @ x[:3], self.v + self.axes.T @ (x[3:] + seen)
        if form == "curvilinear":
            return self._of_sphere(x)
        chief = self.elements
        w, a = chief.perigee, chief.a
        if form == "relative-elements":
            da, dlambda, dex, dey, dix, diy = x / a
            ex, ey = chief.e * np.cos(w) + dex, chief.e * np.sin(w) + dey
            node = diy / np.sin(chief.i)
            perigee = np.arctan2(ey, ex)
            u = w + chief.mean + dlambda - node * np.cos(chief.i)
            return Elements(a * (1 + da), np.hypot(ex, ey), chief.i + dix, chief.node + node,
                            perigee, u - perigee).state(self.mu)
        da, dtheta, di, dq1, dq2, dnode = x
        q1, q2 = chief.e * np.cos(w) + dq1, chief.e * np.sin(w) + dq2
        e, perigee = np.hypot(q1, q2), np.arctan2(q2, q1)
        theta = w + chief.true_anomaly() + dtheta * DEGREE
        return Elements(a + da, e, chief.i + di * DEGREE, chief.node + dnode * DEGREE, perigee,
                        mean_of_true(e, theta - perigee)).state(self.mu)

    def coordinates(self, form: str, r: np.ndarray, v: np.ndarray) -> np.ndarray:
        """The six numbers that describe the deputy's state in this form."""
        if form == "inertial":
            return np.concatenate([r - self.r, v - self.v])
        if form.startswith("RTN"):
            place = self.axes @ (r - self.r)
            seen = 0 if form == "RTN inertial" else np.cross(self.omega, place)
            return np.concatenate([place, self.axes @ (v - self.v) - seen])
        if form == "curvilinear":
            return self._on_sphere(r, v)
        chief, other = self.elements, elements_of(r, v, self.mu)
        dnode = wrapped(other.node - chief.node)
        dq1 = other.e * np.cos(other.perigee) - chief.e * np.cos(chief.perigee)
        dq2 = other.e * np.sin(other.perigee) - chief.e * np.sin(chief.perigee)
        if form == "relative-elements":
            du = wrapped(other.perigee + other.mean - chief.perigee - chief.mean)
            return chief.a * real([other.a / chief.a - 1, du + dnode * np.cos(chief.i), dq1, dq2,
                                   other.i - chief.i, dnode * np.sin(chief.i)])
        dtheta = wrapped(other.perigee + other.true_anomaly() - chief.perigee
                         - chief.true_anomaly())
        return real([other.a - chief.a, dtheta / DEGREE, (other.i - chief.i) / DEGREE, dq1, dq2,
                     dnode / DEGREE])

    def _of_sphere(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        speed = self.r @ self.v / self.distance
        along, above = x[1] / self.distance, x[2] / self.distance
        along_rate = (x[4] - speed * along) / self.distance + self.rate
        above_rate = (x[5] - speed * above) / self.distance
        distance, distance_rate = self.distance + x[0], speed + x[3]
        east = real([-np.sin(along), np.cos(along), 0])
        up = real([np.cos(above) * np.cos(along), np.cos(above) * np.sin(along), np.sin(above)])
        north = real([-np.sin(above) * np.cos(along), -np.sin(above) * np.sin(along),
                      np.cos(above)])
        velocity = (distance_rate * up + distance * np.cos(above) * along_rate * east
                    + distance * above_rate * north)
        return self.axes.T @ (distance * up), self.axes.T @ velocity

    def _on_sphere(self, r: np.ndarray, v: np.ndarray) -> np.ndarray:
        place, velocity = self.axes @ r, self.axes @ v
        speed = self.r @ self.v / self.distance
        distance = np.sqrt(place @ place)
        distance_rate = place @ velocity / distance
        flat = place[0]**2 + place[1]**2
        along, above = np.arctan2(place[1], place[0]), np.arctan2(place[2], np.sqrt(flat))
        along_rate = (place[0] * velocity[1] - place[1] * velocity[0]) / flat - self.rate
        above_rate = (velocity[2] * distance - place[2] * distance_rate) / (
            distance * np.sqrt(flat))
        return real([distance - self.distance, self.distance * along, self.distance * above,
                     distance_rate - speed, self.distance * along_rate + speed * along,
                     self.distance * above_rate + speed * above])

    def sizes(self, form: str, separation: float) -> np.ndarray:
        """What a separation is in each of the six numbers of a form."""
        if form == "relative-elements":
            return np.full(6, separation)
        if form == "element-differences":
            angle = separation / float(self.elements.a)
            degrees = angle / float(DEGREE)
            return np.array([separation, degrees, degrees, angle, angle, degrees])
        return np.array([separation] * 3 + [separation * float(self.rate)] * 3)
