"""Random expressions of the grammar of one's own systems, against mpmath at 50 digits.

Where x and y stay and w' = f(x, y), w is f times the time, and the linear part of the jet has the
derivatives of f likewise: the integration of a constant is exact to rounding. How much rounding makes of
f is sampled: mpmath evaluates it again with every step wrong by a few units of 2^-53.
"""

import random

import pytest

import hamjet

mpmath = pytest.importorskip("mpmath")
mp = mpmath.mp

WANTED = 200
TOGETHER = 6  # states beside x and y
START = {"x": 0.7, "y": -1.3}
TIME = 2.0**-10  # short, so that steep functions take one step too


class Beyond(Exception):
    """A value near the edge of where a function is smooth, or too large."""


class Dual:
    """A value and its derivatives by x and y; `noise` is what rounding makes of each."""

    def __init__(self, value, slopes, noise):
        self.noise = noise
        self.value = noise(value)
        self.slopes = [noise(s) for s in slopes]
        sizes = [abs(self.value), *map(abs, self.slopes)]
        if not all(mpmath.isfinite(s) and s < 1e4 for s in sizes):
            raise Beyond

    def of(self, value, slope):
        return Dual(value, [slope * s for s in self.slopes], self.noise)

    def with_other(self, other, value, by_self, by_other):
        return Dual(value, [by_self * a + by_other * b
                            for a, b in zip(self.slopes, other.slopes)], self.noise)


def inside(condition):
    if not condition:
        raise Beyond


def product(a, b):
    return a.with_other(b, a.value * b.value, b.value, a.value)


def quotient(a, b):
    inside(abs(b.value) > 0.05)
    return a.with_other(b, a.value / b.value, 1 / b.value, -a.value / b.value**2)


def power(a, b):
    inside(a.value > 0.05 and abs(b.value) < 6)
    value = a.value**b.value
    return a.with_other(b, value, b.value * a.value**(b.value - 1), value * mp.log(a.value))


def negative(a):
    return a.of(-a.value, -1)


def natural_power(n):
    def apply(a):
        if n < 0:
            inside(abs(a.value) > 0.05)
        return a.of(a.value**n, n * a.value**(n - 1))
    return apply


def arc_of_two(a, b):
    square = a.value**2 + b.value**2
    inside(square > 0.01 and (b.value > 0 or abs(a.value) > 0.05))
    return a.with_other(b, mp.atan2(a.value, b.value), b.value / square, -a.value / square)


def function(value, slope, condition=lambda x: True):
    def apply(a):
        inside(condition(a.value))
        return a.of(value(a.value), slope(a.value))
    return apply


FUNCTIONS = {
    "sqrt": function(mp.sqrt, lambda x: 1 / (2 * mp.sqrt(x)), lambda x: x > 0.05),
    "exp": function(mp.exp, mp.exp, lambda x: x < 8),
    "log": function(mp.log, lambda x: 1 / x, lambda x: x > 0.05),
    "sin": function(mp.sin, mp.cos),
    "cos": function(mp.cos, lambda x: -mp.sin(x)),
    "tan": function(mp.tan, lambda x: 1 + mp.tan(x)**2, lambda x: abs(mp.cos(x)) > 0.1),
    "asin": function(mp.asin, lambda x: 1 / mp.sqrt(1 - x**2), lambda x: abs(x) < 0.95),
    "acos": function(mp.acos, lambda x: -1 / mp.sqrt(1 - x**2), lambda x: abs(x) < 0.95),
    "atan": function(mp.atan, lambda x: 1 / (1 + x**2)),
    "sinh": function(mp.sinh, mp.cosh, lambda x: abs(x) < 8),
    "cosh": function(mp.cosh, mp.sinh, lambda x: abs(x) < 8),
    "tanh": function(mp.tanh, lambda x: 1 - mp.tanh(x)**2),
}
OPERATIONS = {
    "({} + {})": lambda a, b: a.with_other(b, a.value + b.value, 1, 1),
    "({} - {})": lambda a, b: a.with_other(b, a.value - b.value, 1, -1),
    "{}*{}": product,
    "{}/{}": quotient,
    "{}^{}": power,
    "pow({}, {})": power,
    "atan2({}, {})": arc_of_two,
}


def drawn(generator, depth):
    """An expression as text, and a function that makes its dual of those of x and y."""
    if depth == 0 or generator.random() < 0.1:
        kind = generator.choice("xyxyxycp")
        if kind == "c":
            number = f"{generator.uniform(0.1, 3):.{generator.randint(1, 25)}g}"
            return number, lambda x, y: x.of(mp.mpf(number), 0)
        if kind == "p":
            return "pi", lambda x, y: x.of(+mp.pi, 0)
        return kind, (lambda x, y: x) if kind == "x" else (lambda x, y: y)
    text, inner = drawn(generator, depth - 1)
    choice = generator.random()
    if choice < 0.4:
        name = generator.choice(list(FUNCTIONS))
        return f"{name}({text})", lambda x, y: FUNCTIONS[name](inner(x, y))
    if choice < 0.5:
        if choice < 0.45:
            return f"(-{text})", lambda x, y: negative(inner(x, y))
        # Powers bind closer than signs.
        squared = natural_power(2)
        return f"(-({text})^2)", lambda x, y: negative(squared(inner(x, y)))
    if choice < 0.65:
        n = generator.choice([-3, -2, -1, 2, 3, 4])
        sign = generator.choice(["^", "**"])
        raised = natural_power(n)
        return f"(({text}){sign}{n})", lambda x, y: raised(inner(x, y))
    form = generator.choice(list(OPERATIONS))
    other_text, other = drawn(generator, depth - 1)
    parts = (text, other_text) if "(" == form[0] or "," in form else (f"({text})", f"({other_text})")
    return (f"({form.format(*parts)})",
            lambda x, y: OPERATIONS[form](inner(x, y), other(x, y)))


def evaluated(expression, noise):
    x, y = (mp.mpf(START[name]) for name in "xy")
    result = expression(Dual(x, [1, 0], noise), Dual(y, [0, 1], noise))
    return [result.value, *result.slopes]


def good_expressions():
    """Texts with value, derivatives by x and y, and how far rounding may lead from each."""
    generator = random.Random(20261127)
    found = []
    while len(found) < WANTED:
        text, expression = drawn(generator, generator.randint(2, 6))
        is_constant = "x" not in text.replace("exp", "") and "y" not in text
        if is_constant or any(text == other for other, _, _ in found):
            continue

        def rounded(value):
            return value * (1 + mp.mpf(generator.uniform(-1, 1)) * mp.mpf(2)**-52)

        try:
            exact = evaluated(expression, lambda value: value)
            samples = [evaluated(expression, rounded) for _ in range(12)]
        except (Beyond, ZeroDivisionError):
            continue
        # Steps that a derivative takes in another order round otherwise: four times the sample's
        # largest, and a few units of the value or of 1, which the integration adds.
        scale = max(1, *map(abs, exact))
        bounds = [4 * max(abs(s[i] - exact[i]) for s in samples) + mp.mpf(2)**-48 * scale
                  for i in range(3)]
        found.append((text, exact, bounds))
    return found


def test_values_and_first_derivatives_are_those_of_mpmath():
    with mp.workdps(50):
        expressions = good_expressions()
        for name in FUNCTIONS:
            assert any(name + "(" in text for text, _, _ in expressions), name
        for first in range(0, WANTED, TOGETHER):
            some = expressions[first:first + TOGETHER]
            states = ["x", "y", *(f"w{k}" for k in range(len(some)))]
            field = {"x": "0", "y": "0",
                     **{f"w{k}": text for k, (text, _, _) in enumerate(some)}}
            made = hamjet.system(vector_field=field, states=states)
            jet = hamjet.run(made.scene(START, duration=TIME, order=1)).runs["gauss8"].jet
            for k, (text, exact, bounds) in enumerate(some):
                got = [jet.nominal_final[2 + k], *jet.linear_part[2 + k][:2]]
                for what, value, right, bound in zip(("value", "by x", "by y"), got, exact, bounds):
                    assert abs(mp.mpf(float(value)) / TIME - right) <= bound, (text, what, value, right)
