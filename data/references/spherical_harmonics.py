#!/usr/bin/env python3
"""Taylor coefficients of a made-up field of spherical harmonics, printed as JSON.

The field has all harmonics from degree 1 to 70; `coefficient` gives them, exact in binary64. At each
point all derivatives to order 9 are found from closed forms: a Legendre function by its explicit sum
of powers at 120 digits, a derivative of a harmonic as another harmonic (D+ = d/dx + i d/dy,
D- = d/dx - i d/dy, F_nm = (R/r)^(n+1) P_nm(sin phi) exp(i m lambda), not normalised):

  D+ F_nm = -F_(n+1,m+1) / R,  D- F_nm = (n-m+2)(n-m+1) F_(n+1,m-1) / R,
  Dz F_nm = -(n-m+1) F_(n+1,m) / R.

Checked before anything is printed: along two lines through each point, the same series comes from
the recursions of Legendre functions in univariate power series, to 1e-45 of the largest coefficient of its degree.

Needs mpmath (Debian: python3-mpmath). About five minutes.
"""

import json
import sys
from math import comb, factorial

from mpmath import mp, mpc, mpf, nstr, sqrt

mp.dps = 120
DEGREE = 70
ORDER = 9
POINTS = [
    (0.71, -0.53, 0.62),       # 1.08 R
    (-0.25, 0.125, -1.0),      # towards the south pole
    (0.0, 0.0, 1.0625),        # on the axis
    (0.0, 0.0, -1.0),
    (1e-9, -2e-9, 1.03125),    # beside it
    (1.0, 0.25, 0.0),          # in the equator
    (-1.5, 2.5, 1.75),         # 3.4 R
]


def coefficient(n, m, is_sine):
    """The normalised C_nm or S_nm: pseudo-random numbers between -1/2 and 1/2, divided by n^2."""
    if n == 0 or (m == 0 and is_sine):
        return 0.0
    mixed = (n * 7919 + m * 104729 + (15485863 if is_sine else 0)) * 2654435761 % 2**32
    return (mixed / 2**32 - 0.5) / (n * n)


def norm(n, m):
    return sqrt(mpf((1 if m == 0 else 2) * (2 * n + 1)) * factorial(n - m) / factorial(n + m))


def legendre_derivatives(top, u):
    """d^m P_n / du^m by explicit sums."""
    powers = [mpf(1)]
    for _ in range(top):
        powers.append(powers[-1] * u)
    table = {}
    for n in range(top + 1):
        terms = [(-1) ** k * mpf(factorial(2 * n - 2 * k)) / (2**n * factorial(k) * factorial(n - k))
                 for k in range(n // 2 + 1)]
        for m in range(n + 1):
            table[n, m] = sum(terms[k] / factorial(n - 2 * k - m) * powers[n - 2 * k - m]
                              for k in range((n - m) // 2 + 1))
    return table


def harmonics(point):
    x, y, z = (mpf(v) for v in point)
    r = sqrt(x * x + y * y + z * z)
    top = DEGREE + ORDER
    legendre = legendre_derivatives(top, z / r)
    turn = [mpc(1)]
    for _ in range(top):
        turn.append(turn[-1] * mpc(x, y) / r)
    F = {}
    for n in range(top + 1):
        for m in range(n + 1):
            F[n, m] = legendre[n, m] * turn[m] / r ** (n + 1)
            if m > 0:
                F[n, -m] = (-1) ** m * F[n, m].conjugate() * factorial(n - m) / mpf(factorial(n + m))
    return F


def complex_derivatives(point):
    """Dz^a D+^b U, a + b <= ORDER."""
    F = harmonics(point)
    D = {(a, b): mpc(0) for a in range(ORDER + 1) for b in range(ORDER + 1 - a)}
    for n in range(1, DEGREE + 1):
        for m in range(n + 1):
            c = norm(n, m) * mpc(coefficient(n, m, False), -coefficient(n, m, True))
            for a, b in D:
                up = (-1) ** (a + b) * mpf(factorial(n - m + a)) / factorial(n - m)
                down = (-1) ** a * mpf(factorial(n - m + a + 2 * b)) / factorial(n - m)
                # The real part of c F is half of it and of its conjugate, whose D+ is conj(D- F).
                D[a, b] += (c * up * F[n + a + b, m + b] + (c * down * F[n + a + b, m - b]).conjugate()) / 2
    return D


def taylor(point):
    """The coefficient of dx^i dy^j dz^k by (i, j, k)."""
    D = complex_derivatives(point)
    result = {(i, j, n - i - j): mpc(0) for n in range(ORDER + 1) for i in range(n + 1) for j in range(n + 1 - i)}
    for a in range(ORDER + 1):
        for b in range(ORDER + 1 - a):
            for c in range(ORDER + 1 - a - b):
                # D+ D- = -Dz^2.
                both = min(b, c)
                value = (-1) ** both * D[a + 2 * both, abs(b - c)]
                if c > b:
                    value = value.conjugate()
                value /= mpf(2) ** (b + c) * factorial(a) * factorial(b) * factorial(c)
                for s in range(b + 1):
                    for t in range(c + 1):
                        j = s + t
                        factor = comb(b, s) * comb(c, t) * mpc(0, -1) ** s * mpc(0, 1) ** t
                        result[b + c - j, j, a] += value * factor
    return {key: value.real for key, value in result.items()}


class Series:
    """A power series in one variable, to ORDER."""

    def __init__(self, c):
        self.c = list(c) + [mpf(0)] * (ORDER + 1 - len(c))

    def __add__(self, o):
        return Series([a + b for a, b in zip(self.c, o.c)])

    def __mul__(self, o):
        if not isinstance(o, Series):
            return Series([a * o for a in self.c])
        return Series([sum(self.c[i] * o.c[k - i] for i in range(k + 1)) for k in range(ORDER + 1)])

    def power(self, exponent):
        """By c p' = exponent c' p."""
        p = [self.c[0] ** exponent]
        for k in range(1, ORDER + 1):
            p.append(sum((exponent * i - (k - i)) * self.c[i] * p[k - i] for i in range(1, k + 1)) / (k * self.c[0]))
        return Series(p)


def line(point, direction):
    """The series of U(point + s direction), by recursions of the functions r^-(n+1) A_nm(z/r)."""
    x, y, z = (Series([mpf(p), mpf(d)]) for p, d in zip(point, direction))
    inverse2 = (x * x + y * y + z * z).power(mpf(-1))
    total = Series([mpf(0)])
    sector = (x * x + y * y + z * z).power(mpf(-1) / 2)
    turn = (Series([mpf(1)]), Series([mpf(0)]))
    up = z * inverse2
    for m in range(DEGREE + 1):
        below, now = Series([mpf(0)]), sector
        sums = [Series([mpf(0)]), Series([mpf(0)])]
        for n in range(m, DEGREE + 1):
            for part in range(2):
                sums[part] = sums[part] + now * (norm(n, m) * coefficient(n, m, part == 1))
            above = (up * now * (2 * n + 1) + inverse2 * below * (-(n + m))) * (mpf(1) / (n - m + 1))
            below, now = now, above
        total = total + sums[0] * turn[0] + sums[1] * turn[1]
        sector = sector * inverse2 * (2 * m + 1)
        turn = (x * turn[0] + y * turn[1] * -1, x * turn[1] + y * turn[0])
    return total.c


def check(point, coefficients):
    for direction in [(0.36, 0.48, 0.8), (-0.6, 0.64, -0.48)]:
        v = [mpf(c) for c in direction]
        for n, expected in enumerate(line(point, direction)):
            here = {key: value for key, value in coefficients.items() if sum(key) == n}
            got = sum(value * v[0] ** i * v[1] ** j * v[2] ** k for (i, j, k), value in here.items())
            if abs(got - expected) > mpf(10) ** -45 * max(abs(value) for value in here.values()):
                sys.exit(f"the two ways differ at {point}, degree {n}: {nstr(got, 40)} and {nstr(expected, 40)}")


def main():
    result = []
    for point in POINTS:
        coefficients = taylor(point)
        check(point, coefficients)
        order = sorted(coefficients, key=lambda e: (sum(e), -e[0], -e[1]))
        result.append({"point_hex": [float(v).hex() for v in point],
                       "coefficients": [nstr(coefficients[e], 36) for e in order]})
        print(point, file=sys.stderr, flush=True)
    print(json.dumps({"degree": DEGREE, "order": ORDER, "points": result}, indent=0))


if __name__ == "__main__":
    main()
