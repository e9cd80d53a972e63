"""Ways of deputies: the chief, what is wanted at a time, velocity changes along a frame."""
import numpy as np

import orbit
from flight import REAL, coast_times


class Flights:
    """The chief and what is wanted of the deputy at a time."""

    def __init__(self, scene):
        self.scene, self.field, self.frame = scene, scene.field, scene.transfer_frame
        self.deputy_field = deputy_field_of(scene)

    def chief(self, time):
        return self.field.to(self.scene.chief, time) if time else self.scene.chief

    def end(self, time):
        chief = self.chief(time)
        if self.scene.end_form:
            return orbit.from_form(self.scene.mu, chief, self.scene.end_form, self.scene.end)
        return chief + orbit.from_frame(chief, self.scene.end, *self.frame)

    def axes(self, time):
        return np.eye(3, dtype=REAL) if self.frame[0] == "inertial" else orbit.axes_of(
            self.chief(time))[0]

    def kicked(self, state, time, change):
        """A state after a velocity change along the frame's axes at a time."""
        return np.concatenate([state[:3], state[3:] + np.array(change, dtype=REAL)
                               @ self.axes(time)])

    def on(self, state, time, then):
        return self.deputy_field.to(state, REAL(then) - REAL(time), begin=time) if (
            then != time) else state


def deputy_field_of(scene):
    """What acts on a deputy, which may be unlike its chief."""
    return getattr(scene, "deputy_field", scene.field)


def least_ratio(scene, deputy, time, axes):
    """The least of |(R/a, T/b, N/c)| along the way: where the straight line between two looks comes
    near to the centre there are more of them, seven times."""
    field, other, chief = scene.field, deputy_field_of(scene), scene.chief
    axes = np.array(axes, dtype=REAL)

    def scaled(times, chief, deputy, begin=REAL(0)):
        chiefs, deputies = (of.fly(one, times, begin=begin)
                            for of, one in ((field, chief), (other, deputy)))
        return np.array([orbit.axes_of(c)[0] @ (d - c)[:3] / axes
                         for c, d in zip(chiefs, deputies)]), chiefs, deputies

    times = coast_times(field, chief, time, 60)
    places, chiefs, deputies = scaled(times, chief, deputy)
    least = np.min(orbit.norm(places))
    lines = distances_to_lines(places)
    for k in np.argsort(lines)[:40]:
        if lines[k] > 1.2 * least:
            break
        low, high = REAL(0), times[k + 1] - times[k]
        for _ in range(7):
            inner = low + (high - low) * np.linspace(0, 1, 11).astype(REAL)
            part = scaled(inner, chiefs[k], deputies[k], times[k])[0]
            least = min(least, np.min(orbit.norm(part)))
            nearest = int(np.argmin(distances_to_lines(part)))
            low, high = inner[nearest], inner[nearest + 1]
    return least


def distances_to_lines(places):
    """The distances of the centre from the straight lines between places that follow each other."""
    first, way = places[:-1], np.diff(places, axis=0)
    length = np.maximum(orbit.dot(way, way), REAL(1e-300))
    share = np.clip(-orbit.dot(first, way) / length, 0, 1)
    return orbit.norm(first + share[:, None] * way)
