"""Random expressions of the grammar of one's own systems, against mpmath at 50 digits.

Where x and y stay and w' = f(x, y), w is f times the time, and the jet has the Taylor coefficients of f
likewise: the integration of a constant is exact to rounding. They are compared along lines, on which
mpmath has series in one variable. How much rounding makes of f is sampled: it is evaluated again with
every step wrong by a few units of 2^-53.
"""

import math
import random

import pytest

import hamjet

mpmath = pytest.importorskip("mpmath")
mp = mpmath.mp

WANTED = 200
TOGETHER = 6  # states beside x and y
ORDER = 4
LINES = [(1, 0), (0, 1), (0.75, -0.5)]
SAMPLES = 6
START = {"x": 0.7, "y": -1.3}
TIME = 2.0**-10  # short, so that steep functions take one step too


class Beyond(Exception):
    """A value near the edge of where a function is smooth, or too large."""


class Line:
    """The Taylor series of a function along a line, c_0 + c_1 h + ... to the order of the jets; `noise`
    is what rounding makes of each number."""

    def __init__(self, coefficients, noise):
        self.noise = noise
        self.c = [noise(c) for c in coefficients]
        if not all(mpmath.isfinite(c) and abs(c) < 1e4 for c in self.c):
            raise Beyond

    @property
    def value(self):
        return self.c[0]

    def like(self, coefficients):
        return Line(coefficients, self.noise)

    def constant(self, value):
        return self.like([value] + [0] * ORDER)


def inside(condition):
    if not condition:
        raise Beyond


def total(a, b, sign=1):
    return a.like([x + sign * y for x, y in zip(a.c, b.c)])


def product(a, b):
    return a.like([sum(a.c[k] * b.c[n - k] for k in range(n + 1)) for n in range(ORDER + 1)])


def quotient(a, b):
    inside(abs(b.value) > 0.05)
    c = []
    for n in range(ORDER + 1):
        c.append((a.c[n] - sum(c[k] * b.c[n - k] for k in range(n))) / b.c[0])
    return a.like(c)


def negative(a):
    return a.like([-x for x in a.c])


def solution(u, values, slopes):
    """Functions f_i of u with df_i/du = slopes(f)_i, by as many of Picard's iterations as the order
    has degrees: each makes one more coefficient right."""
    functions = [u.constant(value) for value in values]
    for _ in range(ORDER):
        rates = slopes(*functions)
        functions = [
            u.like([value] + [sum((k + 1) * u.c[k + 1] * rate.c[n - k] for k in range(n + 1)) / (n + 1)
                              for n in range(ORDER)])
            for value, rate in zip(values, rates)]
    return functions[0]


def power(a, b):
    inside(a.value > 0.05 and abs(b.value) < 6)
    return exponential(product(b, logarithm(a)))


def natural_power(n):
    def apply(a):
        result = a
        for _ in range(abs(n) - 1):
            result = product(result, a)
        return quotient(a.constant(1), result) if n < 0 else result
    return apply


def exponential(u):
    return solution(u, [mp.exp(u.value)], lambda f: [f])


def logarithm(u):
    return solution(u, [mp.log(u.value)], lambda f: [quotient(u.constant(1), u)])


def root(u):
    return solution(u, [mp.sqrt(u.value)], lambda f: [quotient(u.constant(0.5), f)])


def square(u):
    return product(u, u)


def arc_tangent(u):
    one = u.constant(1)
    return solution(u, [mp.atan(u.value)], lambda f: [quotient(one, total(one, square(u)))])


def arc_of_two(a, b):
    inside(a.value**2 + b.value**2 > 0.01 and (b.value > 0 or abs(a.value) > 0.05))
    # Of the quotient whose divisor is the larger; the values differ by a constant.
    if abs(b.value) > abs(a.value):
        arc = arc_tangent(quotient(a, b))
    else:
        arc = negative(arc_tangent(quotient(b, a)))
    return a.like([mp.atan2(a.value, b.value), *arc.c[1:]])


def arc_slope(u):
    return quotient(u.constant(1), root(total(u.constant(1), square(u), -1)))


def function(apply, condition=lambda x: True):
    def checked(a):
        inside(condition(a.value))
        return apply(a)
    return checked


FUNCTIONS = {
    "sqrt": function(root, lambda x: x > 0.05),
    "exp": function(exponential, lambda x: x < 8),
    "log": function(logarithm, lambda x: x > 0.05),
    "sin": function(lambda u: solution(u, [mp.sin(u.value), mp.cos(u.value)],
                                       lambda s, c: [c, negative(s)])),
    "cos": function(lambda u: solution(u, [mp.cos(u.value), mp.sin(u.value)],
                                       lambda c, s: [negative(s), c])),
    "tan": function(lambda u: solution(u, [mp.tan(u.value)],
                                       lambda f: [total(u.constant(1), square(f))]),
                    lambda x: abs(mp.cos(x)) > 0.1),
    "asin": function(lambda u: solution(u, [mp.asin(u.value)], lambda f: [arc_slope(u)]),
                     lambda x: abs(x) < 0.9),
    "acos": function(lambda u: solution(u, [mp.acos(u.value)], lambda f: [negative(arc_slope(u))]),
                     lambda x: abs(x) < 0.9),
    "atan": function(arc_tangent),
    "sinh": function(lambda u: solution(u, [mp.sinh(u.value), mp.cosh(u.value)],
                                        lambda s, c: [c, s]), lambda x: abs(x) < 8),
    "cosh": function(lambda u: solution(u, [mp.cosh(u.value), mp.sinh(u.value)],
                                        lambda c, s: [s, c]), lambda x: abs(x) < 8),
    "tanh": function(lambda u: solution(u, [mp.tanh(u.value)],
                                        lambda f: [total(u.constant(1), square(f), -1)])),
}
OPERATIONS = {
    "({} + {})": total,
    "({} - {})": lambda a, b: total(a, b, -1),
    "{}*{}": product,
    "{}/{}": quotient,
    "{}^{}": power,
    "pow({}, {})": power,
    "atan2({}, {})": arc_of_two,
}


def drawn(generator, depth):
    """An expression as text, and a function that makes its series of those of x and y."""
    if depth == 0 or generator.random() < 0.1:
        kind = generator.choice("xyxyxycp")
        if kind == "c":
            number = f"{generator.uniform(0.1, 3):.{generator.randint(1, 25)}g}"
            return number, lambda x, y: x.constant(mp.mpf(number))
        if kind == "p":
            return "pi", lambda x, y: x.constant(+mp.pi)
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
    """The coefficients along each line, one line after the other."""
    found = []
    for direction in LINES:
        x, y = (Line([mp.mpf(START[name]), mp.mpf(slope)] + [0] * (ORDER - 1), noise)
                for name, slope in zip("xy", direction))
        found += expression(x, y).c
    return found


def good_expressions():
    """Texts with their coefficients along the lines, and how far rounding may lead from each."""
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
            samples = [evaluated(expression, rounded) for _ in range(SAMPLES)]
        except (Beyond, ZeroDivisionError):
            continue
        # Steps that a derivative takes in another order round otherwise: eight times the sample's
        # largest, and a few units of the largest coefficient or of 1, which the integration adds.
        scale = max(1, *map(abs, exact))
        bounds = [8 * max(abs(s[i] - exact[i]) for s in samples) + mp.mpf(2)**-48 * scale
                  for i in range(len(exact))]
        found.append((text, exact, bounds))
    return found


def along(jet, component, direction):
    """The coefficients of a component along a line."""
    found = [0.0] * (ORDER + 1)
    for exponents, coefficient in zip(jet.exponents, jet.coefficients[component]):
        powers = [int(e) for e in exponents]
        if any(powers[2:]):
            continue
        found[powers[0] + powers[1]] += float(coefficient) * math.prod(
            slope**power for slope, power in zip(direction, powers))
    return found


def test_jets_are_those_of_mpmath():
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
            jet = hamjet.run(made.scene(START, duration=TIME, order=ORDER,
                                        variables=["x", "y"])).runs["gauss8"].jet
            for k, (text, exact, bounds) in enumerate(some):
                got = [c for direction in LINES for c in along(jet, 2 + k, direction)]
                for n, (value, right, bound) in enumerate(zip(got, exact, bounds)):
                    what = (text, LINES[n // (ORDER + 1)], "degree", n % (ORDER + 1))
                    assert abs(mp.mpf(value) / TIME - right) <= bound, (*what, value, right)
