"""Random scenes of orbits: what a study draws from, with the same numbers for the judge."""
import math

import numpy as np

import orbit
from flight import REAL, Field, coast_times

# mu (km^3/s^2), radius (km), J2 to J6 of the order of the body's.
BODIES = [
    ("Earth", 398600.4415, 6378.1363,
     [1.08262668355315e-3, -2.53265648533224e-6, -1.61962159136700e-6, -2.27296082868698e-7,
      5.40681239107085e-7]),
    ("Moon", 4902.800076, 1738.0, [2.0323e-4, 8.4759e-6, -9.5919e-6, 7.1541e-7, -1.3577e-5]),
    ("Mars", 42828.375214, 3396.19, [1.95545e-3, 3.14498e-5, -1.53774e-5, 5.71855e-6, -4.9e-6]),
]


def rounded(x, digits=9):
    return float(f"{x:.{digits}g}")


class Draw:
    """Random choices of one scene, of the type of `scene`."""

    def __init__(self, seed, index, scene):
        self.generator = np.random.default_rng([seed, index])
        self._scene = scene

    def scene(self, **settings):
        return self._scene(self, **settings)

    def uniform(self, low, high):
        return rounded(self.generator.uniform(low, high))

    def logarithmic(self, low, high):
        return rounded(math.exp(self.generator.uniform(math.log(low), math.log(high))))

    def integer(self, low, high):
        return int(self.generator.integers(low, high + 1))

    def chance(self, share):
        return bool(self.generator.random() < share)

    def one_of(self, choices, weights=None):
        weights = None if weights is None else np.array(weights) / sum(weights)
        return choices[int(self.generator.choice(len(choices), p=weights))]

    def direction(self):
        vector = self.generator.normal(size=3)
        return vector / np.linalg.norm(vector)

    def vector(self, length):
        return [rounded(x) for x in length * self.direction()]


def toml_value(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml_value(x) for x in value) + "]"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    return repr(float(value))


def toml(tables, path=""):
    text, below = "", ""
    for key, value in tables.items():
        name = f"{path}.{key}" if path else key
        if isinstance(value, dict):
            below += f"\n[{name}]\n" + toml(value, name)
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            below += "".join(f"\n[[{name}]]\n" + toml(one, name) for one in value)
        else:
            text += f"{key} = {toml_value(value)}\n"
    return text + below


class Scene:
    """Tables of a scene, and what they mean in SI units."""

    is_earth = False
    has_elements = True  # orbits may be given by elements
    coordinates = {"spherical": 1, "cylindrical": 1, "poincare": 1, "nodal": 2, "flow-box": 5,
                   "auto": 1}

    def __init__(self, draw, revolutions=(0.05, 6), orders=(1, 2, 3, 4), weights=(1, 3, 4, 5),
                 largest_e=0.95, may_go_back=True, coordinates=True, whole=None):
        self.draw = draw
        self.tables = {"title": "attack"}
        self.files = {}
        self._draw_field()
        self._draw_units()
        self._draw_chief(largest_e)
        jet = self.tables["jet"] = {"order": draw.one_of(orders, weights)}
        self._draw_duration(jet, revolutions, may_go_back, whole)
        if coordinates and draw.chance(0.45):
            jet["coordinates"] = draw.one_of(list(self.coordinates),
                                             list(self.coordinates.values()))

    def _draw_field(self):
        draw = self.draw
        self.body, mu, radius, zonals = draw.one_of(BODIES, [8, 1, 1])
        self.mu, self.radius = REAL(mu) * REAL(1e9), REAL(radius) * 1000
        if draw.chance(0.2):
            self.tables["system"] = {"model": "kepler", "mu_km3_s2": mu}
            self.field, self.highest = Field(self.mu), 0
            return
        self.highest = draw.one_of([2, 3, 4, 6], [4, 2, 1, 3])
        taken = zonals[:self.highest - 1]
        self.tables["system"] = {"model": "zonal-gravity", "mu_km3_s2": mu, "radius_km": radius,
                                 **{f"J{n + 2}": J for n, J in enumerate(taken)}}
        self.field = Field(self.mu, self.radius, [0, 0] + taken)

    def _draw_units(self):
        draw = self.draw
        self.length = None
        if draw.chance(0.55):
            length = (draw.logarithmic(1e-3, 1.5e8) if draw.chance(0.6) else
                      draw.one_of([1.0, 0.001, 1000.0, 6378.1363, 149597870.7]))
            self.tables["units"] = {"length_km": length}
            self.length = REAL(length) * 1000

    def given(self, state):
        """A state, in the axes in which the scene gives orbits."""
        return state

    def meant(self, given):
        """The state that a scene gives."""
        return given

    def _draw_shape(self, largest_e):
        """a (km), e and i (degrees)."""
        draw = self.draw
        radius = float(self.radius) / 1000
        kind = draw.one_of(["circle", "low", "middle", "high", "highest"], [2, 8, 6, 4, 3])
        e = min(largest_e, {"circle": 0.0 if draw.chance(0.4) else draw.logarithmic(1e-6, 1e-3),
                            "low": draw.uniform(0.001, 0.1), "middle": draw.uniform(0.1, 0.4),
                            "high": draw.uniform(0.4, 0.8),
                            "highest": draw.uniform(0.8, 0.95)}[kind])
        perigee = draw.logarithmic(1.04, 1.3 if draw.chance(0.7) else 7) * radius
        a = rounded(perigee / (1 - e), 10)
        i = draw.uniform(3, 177)
        if draw.chance(0.15):
            i = draw.one_of([90.0, 63.4349488229, 116.565, 28.5, 0.01, 97.4, 0.0, 180.0])
        return a, e, i

    def _draw_form(self):
        form = self.draw.one_of(["elements", "period", "heights", "state"], [5, 1, 1, 3])
        if form == "heights" and "radius_km" not in self.tables["system"]:
            form = "elements"
        return form

    def _draw_chief(self, largest_e):
        draw = self.draw
        radius = float(self.radius) / 1000
        a, e, i = self._draw_shape(largest_e)
        node, w, place = draw.uniform(-180, 180), draw.uniform(-180, 180), draw.uniform(-180, 180)
        if draw.chance(0.2):
            place = draw.one_of([0.0, 180.0, 90.0])
        self.e, self.i = REAL(e), orbit.degrees(i)
        self.has_node = 0 < i < 180
        form = self._draw_form()
        nominal = {}
        if form == "period":
            nominal["period_s"] = rounded(2 * math.pi * math.sqrt((a * 1e3) ** 3 / float(self.mu)))
            n = 2 * orbit.PI / REAL(nominal["period_s"])
            self.a = (self.mu / n ** 2) ** (REAL(1) / 3)
            nominal["e"] = e
        elif form == "heights":
            low, high = rounded(a * (1 - e) - radius), rounded(a * (1 + e) - radius)
            low, high = min(low, high), max(low, high)
            nominal.update(perigee_height_km=low, apogee_height_km=high)
            self.a = (REAL(low) + REAL(high)) / 2 * 1000 + self.radius
            self.e = (REAL(high) - REAL(low)) / 2 * 1000 / self.a
        else:
            self.a = REAL(a) * 1000
            nominal.update(a_km=a, e=e)
        anomaly = draw.one_of(["ta_deg", "ea_deg", "ma_deg", "u_deg"], [4, 1, 1, 1])
        nominal.update(i_deg=i, raan_deg=node, argp_deg=w)
        nominal[anomaly] = place
        angle = orbit.degrees(place)
        if anomaly == "ma_deg":
            angle = orbit.true_of_eccentric(orbit.eccentric_anomaly(angle, self.e), self.e)
        elif anomaly == "ea_deg":
            angle = orbit.true_of_eccentric(angle, self.e)
        elif anomaly == "u_deg":
            angle -= orbit.degrees(w)
        state = orbit.state_of(self.mu, self.a, self.e, self.i, orbit.degrees(node),
                               orbit.degrees(w), angle)
        if form == "state":
            state = self.given(state)
            nominal = {"position_km": [rounded(x / 1000, 12) for x in state[:3]],
                       "velocity_km_s": [rounded(x / 1000, 12) for x in state[3:]]}
            state = np.array(nominal["position_km"] + nominal["velocity_km_s"], dtype=REAL) * 1000
        state = self.meant(state)
        self.tables.setdefault("nominal", {}).update(nominal)
        self.chief = state
        self.period = self.field.period(state)
        self.rate = 2 * orbit.PI / self.period
        distance = orbit.norm(state[:3])
        if self.length is None:
            self.length = distance
        self.time_unit = np.sqrt(self.length ** 3 / self.mu)

    def _draw_duration(self, jet, revolutions, may_go_back, whole):
        draw = self.draw
        low, high = revolutions
        kind = draw.one_of(["any", "short", "whole", "half"], [5, 2, 3, 1])
        if whole:
            count = whole
        elif kind == "any":
            count = draw.uniform(low, high)
        elif kind == "short":
            count = draw.uniform(low, max(low, min(1.0, high)))
        elif kind == "whole":
            count = float(draw.integer(1, max(1, int(high))))
        else:
            count = draw.integer(1, max(1, int(2 * high))) / 2
        if may_go_back and draw.chance(0.15):
            count = -count
        if draw.chance(0.6):
            jet["duration_orbits"] = count
            self.duration = REAL(count) * self.period
        else:
            # In decimals, so that a whole period is whole to the last digit of a double.
            jet["duration_s"] = float(REAL(count) * self.period)
            self.duration = REAL(jet["duration_s"])
        self.revolutions = float(self.duration / self.period)

    # What belongs to a deputy.

    def frame(self, table, default_derivatives="rotating"):
        """Draws the frame of a table, and gives its name and derivatives."""
        draw = self.draw
        frame = draw.one_of(["RTN", "inertial"], [3, 1])
        if frame == "inertial" or draw.chance(0.5):
            table["frame"] = frame
        derivatives = default_derivatives
        if frame == "RTN" and draw.chance(0.4):
            derivatives = table["derivatives"] = draw.one_of(["rotating", "inertial"])
        return frame, derivatives

    def deputy(self, table, chief, distance, frame, forms=True):
        """Draws a deputy about so far from a chief, into a table, and gives its inertial state.
        `frame` is a name with derivatives."""
        draw = self.draw
        kinds = ["rest", "state"]
        if forms and self.has_node:
            kinds += ["own-state", "own-elements", *orbit.FORMS]
        kind = draw.one_of(kinds, [2, 4, 1, 1, 1, 2, 1][:len(kinds)])
        rate = float(self.rate)
        if kind in ("rest", "state"):
            table["position_m"] = draw.vector(distance)
            state = table["position_m"] + [0.0] * 3
            if kind == "state":
                table["velocity_m_s"] = draw.vector(distance * rate * draw.uniform(0, 1))
                state = table["position_m"] + table["velocity_m_s"]
            return chief + orbit.from_frame(chief, state, *frame)
        near = chief + np.array(draw.vector(distance) + draw.vector(distance * rate / 2),
                                dtype=REAL)
        if kind == "own-state" or (kind == "own-elements" and not self.has_elements):
            near = self.given(near)
            table["position_km"] = [rounded(x / 1000, 15) for x in near[:3]]
            table["velocity_km_s"] = [rounded(x / 1000, 15) for x in near[3:]]
            return self.meant(np.array(table["position_km"] + table["velocity_km_s"], dtype=REAL)
                              * 1000)
        if kind == "own-elements":
            k = orbit.elements_of(self.mu, self.given(near))
            e, w = np.hypot(k["q1"], k["q2"]), np.arctan2(k["q2"], k["q1"])
            turn = 180 / orbit.PI
            table.update(a_km=rounded(k["a"] / 1000, 14), e=rounded(e, 13),
                         i_deg=rounded(k["i"] * turn, 14), raan_deg=rounded(k["node"] * turn, 14),
                         argp_deg=rounded(w * turn, 14),
                         ta_deg=rounded(orbit.wrapped(k["theta"] - w) * turn, 14))
            return self.meant(orbit.state_of(self.mu, REAL(table["a_km"]) * 1000, table["e"],
                                             *(orbit.degrees(table[key]) for key in
                                               ("i_deg", "raan_deg", "argp_deg", "ta_deg"))))
        numbers = [rounded(x) for x in orbit.to_form(self.mu, chief, near, kind)]
        if kind == "relative-elements" and draw.chance(0.5):
            numbers[0] = 0.0
        table.update(zip(orbit.FORMS[kind], numbers))
        return orbit.from_form(self.mu, chief, kind, numbers)

    def times(self, most):
        """Keys of up to so many times within the duration, and the times in seconds."""
        draw = self.draw
        count = draw.integer(1, most)
        kind = draw.one_of(["count", "times_s", "times_orbits"])
        if kind == "count":
            return {"count": count}, [self.duration * k / count for k in range(1, count + 1)]
        shares = np.sort(draw.generator.uniform(0.02, 1, size=count))
        if draw.chance(0.5):
            shares[-1] = 1
        unit = self.period if kind == "times_orbits" else REAL(1)
        times = sorted({rounded(float(s * self.duration / unit), 12) for s in shares}, key=abs)
        # The last one may not lie beyond the duration by its own rounding.
        times = [t for t in times if abs(REAL(t) * unit) <= abs(self.duration)]
        if not times:
            return {"count": 1}, [self.duration]
        return {kind: times}, [REAL(t) * unit for t in times]

    @property
    def text(self):
        return toml(self.tables)

    def chief_at(self, time):
        return self.field.to(self.chief, time)

    def lowest(self):
        """Least distance of the chief from the centre within the duration."""
        states = self.field.fly(self.chief, coast_times(self.field, self.chief, self.duration, 20))
        return np.min(orbit.norm(states[:, :3]))
