"""The judgement of a scene: right, marked as doubtful by the program itself, or wrong."""
import math

import numpy as np


class Judgement:
    def __init__(self):
        self.faults, self.marks, self.notes = [], [], []
        self.checks = 0

    def wrong(self, text):
        self.faults.append(text)

    def mark(self, text):
        """The program itself says that it is in doubt."""
        self.marks.append(text)

    def note(self, name, value):
        """A number for the statistics."""
        self.notes.append((name, float(value)))

    def within(self, name, told, true, allowed):
        """Compares numbers or vectors, by the length of their difference."""
        self.checks += 1
        if told is None or not np.all(np.isfinite(np.asarray(told, dtype=float))):
            self.wrong(f"{name}: told {told}, true {true}")
            return False
        difference = float(np.linalg.norm(np.asarray(np.subtract(told, true), dtype=float)))
        if difference <= allowed:
            return True
        self.wrong(f"{name}: told {shown(told)}, true {shown(true)}, {difference:.4g} apart, "
                   f"allowed {float(allowed):.3g}")
        return False

    def at_most(self, name, value, limit):
        self.checks += 1
        if value is not None and math.isfinite(value) and value <= limit:
            return True
        self.wrong(f"{name}: {shown(value)}, must be at most {shown(limit)}")
        return False

    def require(self, name, condition):
        self.checks += 1
        if not condition:
            self.wrong(name)
        return bool(condition)

    @property
    def outcome(self):
        if self.faults:
            return "wrong"
        if self.marks:
            return "marked"
        return "right" if self.checks else "marked"


def shown(x):
    if x is None:
        return "nothing"
    if np.ndim(x) == 0:
        return f"{float(x):.9g}"
    return "(" + ", ".join(f"{float(y):.9g}" for y in np.ravel(x)) + ")"
