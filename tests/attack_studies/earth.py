"""The real Earth of the attack: dates, tables of its orientation, axes, and flights about it."""
import datetime
import os

import numpy as np

from air import density_profiles
from flight import LIBRARY, PI, REAL, Field, address

SHIPPED = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "data", "gravity",
                       "EGM96-to-20.gfc")
MU_SUN, MU_MOON = REAL("132712440041.27942e9"), REAL("4902.800118e9")
TT_MINUS_TAI, TAI_MINUS_GPS = REAL("32.184"), 19
JULIAN_DATE_OF_1970 = 2440587.5
FIRST_DAY = datetime.date(1970, 1, 1)
ARCSECOND = PI / 648000
AXES = {"ITRF": 0, "EME2000": 1, "MOD": 2, "TOD": 3}


def shipped_field():
    """mu, radius, and the normalised coefficients C and S by degree and order."""
    with open(SHIPPED) as file:
        rows = [line.replace("D", "e").split() for line in file]
    head = {row[0]: row[1] for row in rows if len(row) == 2}
    C, S = np.zeros((21, 21), dtype=REAL), np.zeros((21, 21), dtype=REAL)
    for row in rows:
        if row and row[0] == "gfc":
            C[int(row[1]), int(row[2])], S[int(row[1]), int(row[2])] = REAL(row[3]), REAL(row[4])
    return REAL(head["earth_gravity_constant"]), REAL(head["radius"]), C, S


def made_up_field(draw, degree):
    """As shipped_field, with the Earth's J2 and all else drawn of the sizes of Kaula's rule; and the
    text of its file."""
    mu, radius, shipped_C, _ = shipped_field()
    C, S = np.zeros((degree + 1,) * 2, dtype=REAL), np.zeros((degree + 1,) * 2, dtype=REAL)
    C[0, 0] = 1
    lines = ["product_type gravity_field", "modelname MADE_UP",
             f"earth_gravity_constant {mu}", f"radius {radius}", f"max_degree {degree}",
             "tide_system tide_free", "end_of_head", "gfc 0 0 1.0 0.0"]
    for n in range(2, degree + 1):
        for m in range(n + 1):
            pair = [draw.uniform(-1e-5, 1e-5) / n ** 2 for _ in range(2)]
            if m == 0:
                pair = [float(shipped_C[2, 0]) if n == 2 else pair[0], 0.0]
            C[n, m], S[n, m] = pair
            lines.append(f"gfc {n} {m} {pair[0]!r} {pair[1]!r}")
    return (mu, radius, C, S), "\n".join(lines) + "\n"


def tai_minus_utc(day, fraction=0.0):
    fraction = np.array([fraction])
    return REAL(round(LIBRARY.tai_minus_utc(day.year, day.month, day.day, address(fraction)), 12))


class Moment:
    """A date of TT: the day, and seconds after its midnight."""

    def __init__(self, day, seconds):
        self.day, self.seconds = day, REAL(seconds)

    @classmethod
    def of(cls, system, day, seconds):
        """Of a day and seconds in a time system; within a leap second there are 86400 and more."""
        seconds = REAL(seconds)
        later = {"tt": REAL(0), "tai": TT_MINUS_TAI, "gps": TT_MINUS_TAI + TAI_MINUS_GPS}
        if system == "utc":
            # Before 1972 UTC ran at another rate within the day.
            fraction = 0.0 if day.year >= 1972 else float(seconds / 86400)
            return cls(day, seconds + tai_minus_utc(day, fraction) + TT_MINUS_TAI)
        return cls(day, seconds + later[system])

    @property
    def julian_day(self):
        return JULIAN_DATE_OF_1970 + (self.day - FIRST_DAY).days

    def since(self, other):
        return REAL((self.day - other.day).days) * 86400 + (self.seconds - other.seconds)

    def tai_minus_utc(self):
        """The difference at this moment, found on the day of UTC that it belongs to."""
        for back in range(3):
            day = self.day - datetime.timedelta(days=back - 1)
            start = Moment.of("utc", day, 0)
            since = self.since(start)
            if since >= 0:
                # Before 1972 TAI - UTC grows at a rate of 3e-8, so that the fraction need not be
                # refined.
                fraction = 0.0 if day.year >= 1972 else min(float(since / 86400), 0.99999999)
                return tai_minus_utc(day, fraction)
        raise AssertionError("no day of UTC")


class Orientation:
    """A table in the form of finals2000A, and its rows in radians and seconds after an epoch."""

    def __init__(self, draw, epoch, reach):
        # Terms of the sizes and periods that the Earth has, in days.
        periods = np.array([365.25, 182.6, 27.55, 13.66, 433.0])
        phases = draw.generator.uniform(0, 2 * np.pi, size=(5, 5))
        sizes = np.array([[0.02, 0.009, 8e-4, 8e-4, 0.0], [0.1, 0, 0, 0, 0.16],
                          [0.1, 0, 0, 0, 0.16], [2e-4, 0, 0, 1e-4, 2e-4], [2e-4, 0, 0, 1e-4, 2e-4]])
        middle = np.array([draw.uniform(-0.8, 0.8), 0.05, 0.35, 0, 0])
        rate = np.array([draw.uniform(-3e-3, 3e-3), 0, 0, 0, 0])
        lines, rows = [], []
        # UT1 - TAI goes on where UTC jumps.
        at_epoch = tai_minus_utc(epoch.day)
        for k in range(-reach, reach + 1):
            day = epoch.day + datetime.timedelta(days=k)
            values = middle + rate * k + np.sum(
                sizes * np.sin(2 * np.pi * k / periods + phases), axis=1)
            offset = tai_minus_utc(day)
            texts = [f"{values[0] + float(offset - at_epoch):10.7f}", f"{values[1]:9.6f}",
                     f"{values[2]:9.6f}", f"{values[3] * 1000:9.3f}", f"{values[4] * 1000:9.3f}"]
            lines.append(self._line(day, texts))
            ut1, x, y, dx, dy = (REAL(text.strip()) for text in texts)
            rows.append([Moment.of("utc", day, 0).since(epoch), ut1 - offset - TT_MINUS_TAI,
                         x * ARCSECOND, y * ARCSECOND, dx * ARCSECOND / 1000,
                         dy * ARCSECOND / 1000])
        self.text = "\n".join(lines) + "\n"
        self.rows = np.array(rows, dtype=REAL)

    @staticmethod
    def _line(day, texts):
        """Columns of Bulletin A, counted from 1."""
        line = list(" " * 185)

        def put(first, text):
            line[first - 1:first - 1 + len(text)] = text

        mjd = (day - datetime.date(1858, 11, 17)).days
        put(1, f"{day.year % 100:2d}{day.month:2d}{day.day:2d} {mjd:8.2f} I")
        put(19, texts[1])
        put(38, texts[2])
        put(58, "I")
        put(59, texts[0])
        put(96, "I")
        put(98, texts[3])
        put(117, texts[4])
        return "".join(line).rstrip()


class EarthField(Field):
    """Flights along GCRF; times are seconds after the epoch."""

    def __init__(self, gravity, degree, order, sun, moon, epoch, orientation=None, air=None,
                 radiation_m2_kg=REAL(0)):
        """The gravity is as shipped_field gives it, taken up to a degree and order. The air, if there
        is any, is its model, the exponent of its bulge, and C_D A / m times the factor of all densities; the light is that of C_R A / m, without a shadow until light_chief."""
        self._settings = gravity, degree, order, sun, moon, epoch, orientation
        self._lights = None
        self.air, self.radiation_m2_kg = air, radiation_m2_kg
        mu, radius, C, S = gravity
        super().__init__(mu, radius)
        below = [(n, m) for n in range(degree + 1) for m in range(n + 1)]
        of_degree = [np.array([x[n, m] if m <= order else 0 for n, m in below], dtype=REAL)
                     for x in (C, S)]
        constants = np.array([mu, radius, MU_SUN if sun else 0, MU_MOON if moon else 0,
                              epoch.seconds, -epoch.tai_minus_utc() - TT_MINUS_TAI,
                              air[2] if air else 0, radiation_m2_kg], dtype=REAL)
        day = np.array([epoch.julian_day])
        rows = np.zeros((0, 6), dtype=REAL) if orientation is None else orientation.rows
        profiles = density_profiles(air[0]) if air else np.zeros((0, 0, 9), dtype=REAL)
        self._earth = LIBRARY.make_earth(degree, *(address(x) for x in of_degree),
                                         address(constants), address(day), len(rows),
                                         address(rows), air[1] if air else 0, *profiles.shape[:2],
                                         address(profiles))

    def of_spacecraft(self, drag_m2_kg, radiation_m2_kg):
        """The same Earth for another spacecraft, in the light of the same chief."""
        air = self.air and (*self.air[:2], drag_m2_kg)
        other = EarthField(*self._settings, air, radiation_m2_kg)
        if self._lights:
            other.share_light(self._lights)
        return other

    def light_chief(self, chief):
        """Light with a shadow: what is seen of the Sun along the orbit of this chief."""
        chief = np.array(chief, dtype=REAL)
        LIBRARY.light_chief(self._earth, address(self._centre), address(chief))
        self._lights = self

    def share_light(self, of_chief):
        LIBRARY.share_light(self._earth, of_chief._earth)
        self._lights = of_chief  # whose flights find the light

    def __del__(self):
        LIBRARY.delete_earth(self._earth)

    def axes(self, name, time=0):
        """The matrix from GCRF and its rate. Axes of date other than ITRF rest as they lie."""
        if name == "GCRF":
            return np.eye(3, dtype=REAL), np.zeros((3, 3), dtype=REAL)
        out, time = np.empty((2, 3, 3), dtype=REAL), np.array([time], dtype=REAL)
        LIBRARY.axes_of_earth(self._earth, AXES[name], address(time), address(out))
        return out[0], out[1]

    def to_axes(self, name, state):
        """A state at the epoch along GCRF, along other axes."""
        matrix, rate = self.axes(name)
        return np.concatenate([matrix @ state[:3], matrix @ state[3:] + rate @ state[:3]])

    def from_axes(self, name, state):
        matrix, rate = self.axes(name)
        return np.concatenate([matrix.T @ state[:3], matrix.T @ state[3:] + rate.T @ state[:3]])
