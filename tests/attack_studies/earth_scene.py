"""Random scenes about the real Earth."""
import datetime
import math

import orbit
from drawing import Scene, rounded
from earth import (EarthField, Moment, Orientation, made_up_field, shipped_field,
                   tai_minus_utc)
from flight import REAL

FIRST, LAST = datetime.date(1970, 1, 1), datetime.date(2050, 12, 31)
MOST_DAYS = 4
MOST_DAYS_IN_AIR = 1.5
TABLE_DAYS = MOST_DAYS + 8


def days_with_leap_second():
    starts = [datetime.date(year, month, 1) for year in range(1972, 2018) for month in (1, 7)]
    before = [start - datetime.timedelta(days=1) for start in starts]
    return [day for day, start in zip(before, starts)
            if day.year >= 1972 and tai_minus_utc(start) > tai_minus_utc(day)]


class EarthScene(Scene):
    is_earth = True
    coordinates = {"spherical": 1, "cylindrical": 1, "poincare": 1, "nodal": 2, "auto": 2}

    def __init__(self, draw, fine_field=False, **settings):
        """A fine field is made up, of a degree beyond the shipped one and up to 70."""
        self.fine_field = fine_field
        super().__init__(draw, **settings)

    def given(self, state):
        return self.field.to_axes(self.axes_name, state)

    def meant(self, given):
        return self.field.from_axes(self.axes_name, given)

    def _draw_field(self):
        draw = self.draw
        self.body = "Earth"
        system = self.tables["system"] = {"model": "earth"}
        if self.fine_field:
            degree = draw.integer(21, 70)
            gravity, self.files["made_up.gfc"] = made_up_field(draw, degree)
            system["gravity_file"] = "made_up.gfc"
        else:
            gravity = shipped_field()
            degree = draw.one_of([2, draw.integer(3, 19), 20], [1, 3, 3])
        self.highest = degree
        self.mu, self.radius = gravity[:2]
        if degree != 20 or draw.chance(0.3):
            system["gravity_degree"] = degree
        order = degree
        if draw.chance(0.4):
            order = system["gravity_order"] = draw.one_of([0, draw.integer(0, degree), degree])
        sun, moon = draw.chance(0.7), draw.chance(0.7)
        for name, acts in (("sun", sun), ("moon", moon)):
            if not acts or draw.chance(0.2):
                system[name] = acts
        nominal = self.tables["nominal"] = {}
        self.epoch = self._draw_epoch(nominal)
        self.axes_name = draw.one_of(["GCRF", "EME2000", "MOD", "TOD", "ITRF"], [3, 2, 1, 3, 4])
        if self.axes_name != "GCRF" or draw.chance(0.3):
            nominal["axes"] = self.axes_name
        # In axes that turn with the Earth velocities are not those of an orbit, so that there are
        # no elements.
        self.has_elements = self.axes_name != "ITRF"
        orientation = None
        if draw.chance(0.5):
            system["orientation_file"] = "finals.txt"
            orientation = Orientation(draw, self.epoch, TABLE_DAYS)
            self.files["finals.txt"] = orientation.text
        air = self._draw_air(system) if draw.chance(0.45) else None
        self.field = EarthField(gravity, degree, order, sun, moon, self.epoch, orientation, air,
                                self._draw_light(system, sun))

    def _draw_air(self, system):
        draw = self.draw
        model = system["atmosphere"] = draw.one_of(["harris-priester", "exponential"], [2, 1])
        self.density_factor, exponent = 1.0, 4
        if draw.chance(0.4):
            self.density_factor = system["density_factor"] = draw.logarithmic(0.3, 3)
        if draw.chance(0.5):
            exponent = system["bulge_exponent"] = draw.one_of([2, 4, 6])
        self.tables["spacecraft"], drag = self.draw_spacecraft()
        return model, exponent, drag * REAL(self.density_factor)

    def draw_spacecraft(self):
        """A table [spacecraft], and its C_D A / m."""
        draw = self.draw
        drag = draw.logarithmic(5e-4, 0.05)
        if draw.chance(0.6):
            return {"drag_m2_kg": drag}, REAL(drag)
        table = {"mass_kg": draw.logarithmic(1, 2000)}
        coefficient = 2.2
        if draw.chance(0.6):
            coefficient = table["drag_coefficient"] = draw.uniform(2, 3)
        table["area_m2"] = rounded(drag * table["mass_kg"] / coefficient)
        return table, REAL(coefficient) * REAL(table["area_m2"]) / REAL(table["mass_kg"])

    def unlike_deputy(self, table):
        """Gives a deputy another coefficient, often one near the chief's, in which polynomials are
        expanded; its field."""
        draw = self.draw
        table["spacecraft"], drag = self.draw_spacecraft()
        if draw.chance(0.6):
            drag = REAL(float(self.field.air[2] / self.density_factor) * draw.uniform(0.7, 1.3))
            table["spacecraft"] = {"drag_m2_kg": float(drag)}
        light = self.field.radiation_m2_kg
        if light and ("mass_kg" in table["spacecraft"] or draw.chance(0.3)):
            light = REAL(float(light) * draw.uniform(0.7, 1.3))
            table["spacecraft"]["radiation_m2_kg"] = float(light)
        return self.field.of_spacecraft(drag * REAL(self.density_factor), light)

    def coefficients(self):
        """What jets may be expanded in, with the chief's values."""
        found = {}
        if self.field.air:
            found["drag_m2_kg"] = self.field.air[2] / REAL(self.density_factor)
            found["density_factor"] = REAL(self.density_factor)
        if self.field.radiation_m2_kg:
            found["radiation_m2_kg"] = self.field.radiation_m2_kg
        return found

    def with_change(self, change):
        """The field of a chief whose coefficients differ by so much."""
        now = {name: value + change.get(name, 0) for name, value in self.coefficients().items()}
        return self.field.of_spacecraft(
            now.get("drag_m2_kg", REAL(0)) * now.get("density_factor", REAL(0)),
            now.get("radiation_m2_kg", REAL(0)))

    def _draw_light(self, system, sun):
        draw = self.draw
        self.has_shadow = False
        if not sun or not draw.chance(0.35):
            return REAL(0)
        system["radiation"] = True
        self.has_shadow = draw.chance(0.7)
        if not self.has_shadow:
            system["shadow"] = "none"
        elif draw.chance(0.3):
            system["shadow"] = "conical"
        light = draw.logarithmic(5e-4, 0.3)
        self.tables.setdefault("spacecraft", {})["radiation_m2_kg"] = light
        return REAL(light)

    def _draw_epoch(self, nominal):
        draw = self.draw
        system = draw.one_of(["utc", "tt", "tai", "gps"], [4, 2, 2, 2])
        day = FIRST + datetime.timedelta(days=draw.integer(0, (LAST - FIRST).days))
        picoseconds = draw.integer(0, 86400 * 10 ** 6 - 1) * 10 ** 6
        if draw.chance(0.2):
            picoseconds = draw.one_of([0, 43200]) * 10 ** 12
        if system == "utc" and draw.chance(0.15):
            # Right before a leap second or within it.
            day = draw.one_of(days_with_leap_second())
            picoseconds = (86400 * 10 ** 6 + draw.integer(-3600 * 10 ** 6, 10 ** 6 - 1)) * 10 ** 6
        whole, parts = divmod(picoseconds, 10 ** 12)
        minutes = min(whole // 60, 1439)
        date = day.isoformat() if draw.chance(0.8) else f"{day.year}-{day.timetuple().tm_yday:03d}"
        fraction = f".{parts // 10 ** 6:06d}" if parts or draw.chance(0.5) else ""
        nominal["epoch_" + system] = (f"{date}T{minutes // 60:02d}:{minutes % 60:02d}:"
                                      f"{whole - 60 * minutes:02d}{fraction}")
        return Moment.of(system, day, REAL(picoseconds) / 10 ** 12)

    def _draw_form(self):
        if not self.has_elements:
            return "state"
        return self.draw.one_of(["elements", "period", "heights", "state"], [5, 1, 1, 3])

    def _draw_shape(self, largest_e):
        draw = self.draw
        kind = draw.one_of(["low", "sun-synchronous", "retrograde", "half-day", "geostationary",
                            "molniya", "transfer", "any"], [5, 2, 2, 2, 3, 2, 2, 3])
        low = (float(self.radius) + draw.uniform(2.5e5, 1.5e6)) / 1000
        e = 0.0 if draw.chance(0.2) else draw.logarithmic(1e-6, 0.05)
        i = draw.uniform(0.5, 179.5)
        if kind == "low":
            return rounded(low / (1 - e), 10), e, i
        if kind == "sun-synchronous":
            return rounded(low / (1 - e), 10), e, draw.uniform(96.5, 101)
        if kind == "retrograde":
            e = draw.uniform(0, 0.3)
            return rounded(low / (1 - e), 10), e, draw.uniform(120, 179.9)
        if kind == "half-day":
            return draw.uniform(26550, 26570), min(e, 0.02), draw.uniform(50, 70)
        if kind == "geostationary":
            return draw.uniform(42150, 42180), draw.logarithmic(1e-5, 0.01), draw.uniform(0.01, 12)
        if kind == "molniya":
            e = draw.uniform(0.7, 0.74)
            return draw.uniform(26550, 26570), e, draw.uniform(62, 65)
        if kind == "transfer":
            e = rounded((42164 - low) / (42164 + low))
            return rounded(low / (1 - e), 10), e, draw.uniform(0.5, 60)
        e = draw.uniform(0.05, 0.8)
        perigee = low * draw.logarithmic(1, 2)
        return rounded(perigee / (1 - e), 10), e, i

    def _draw_chief(self, largest_e):
        super()._draw_chief(largest_e)
        # The elements are those of the orbit that is flown, because the scene's axes may be others.
        k = orbit.elements_of(self.mu, self.chief)
        self.i, self.e = k["i"], orbit.eccentricity(self.mu, self.chief)
        self.has_node = True
        if self.has_shadow:
            self.field.light_chief(self.chief)

    def _draw_duration(self, jet, revolutions, may_go_back, whole):
        # Air that is dense brings an orbit down within days.
        days = MOST_DAYS if self.field.air is None else MOST_DAYS_IN_AIR
        most = days * 86400 / float(self.period)
        low, high = revolutions
        super()._draw_duration(jet, (min(low, most / 2), min(high, math.floor(2 * most) / 2)),
                               may_go_back, whole)
