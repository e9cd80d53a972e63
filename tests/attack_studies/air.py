"""The air of the attack: published tables, and the spline through the logarithms of their densities
that hamjet's pages describe, found here from truncated powers in decimals of 150 digits."""
import decimal
import functools

import numpy as np

from flight import REAL

DIGITS = 150
DEGREE = 7

# O. Montenbruck and E. Gill, Satellite Orbits, 2000, table 3.8: km, least and greatest g/km^3.
HARRIS_PRIESTER = """
100 497400 497400|120 24900 24900|130 8377 8710|140 3899 4059|150 2122 2215|160 1263 1344
170 800.8 875.8|180 528.3 601|190 361.7 429.7|200 255.7 316.2|210 183.9 239.6|220 134.1 185.3
230 99.49 145.5|240 74.88 115.7|250 57.09 93.08|260 44.03 75.55|270 34.3 61.82|280 26.97 50.95
290 21.39 42.26|300 17.08 35.26|320 10.99 25.11|340 7.214 18.19|360 4.824 13.37|380 3.274 9.955
400 2.249 7.492|420 1.558 5.684|440 1.091 4.355|460 .7701 3.362|480 .5474 2.612|500 .3916 2.042
520 .2819 1.605|540 .2042 1.267|560 .1488 1.005|580 .1092 .7997|600 .0807 .639|620 .06012 .5123
640 .04519 .4121|660 .0343 .3325|680 .02632 .2691|700 .02043 .2185|720 .01607 .1779|740 .01281 .1452
760 .01036 .119|780 .008496 .09776|800 .007069 .08059|840 .00468 .05741|880 .0032 .0421
920 .00221 .0313|960 .00156 .0236|1000 .00115 .0181
"""
# D. A. Vallado, Fundamentals of Astrodynamics and Applications, 4th ed., table 8-4: km and kg/m^3;
# above the last one the density falls with its scale height, 268 km.
EXPONENTIAL = """
0 1.225|25 3.899e-2|30 1.774e-2|40 3.972e-3|50 1.057e-3|60 3.206e-4|70 8.77e-5|80 1.905e-5
90 3.396e-6|100 5.297e-7|110 9.661e-8|120 2.438e-8|130 8.484e-9|140 3.845e-9|150 2.07e-9
180 5.464e-10|200 2.789e-10|250 7.248e-11|300 2.418e-11|350 9.518e-12|400 3.725e-12|450 1.585e-12
500 6.967e-13|600 1.454e-13|700 3.614e-14|800 1.17e-14|900 5.245e-15|1000 3.019e-15
"""


def rows_of(text):
    return [[decimal.Decimal(x) for x in row.split()] for row in text.replace("|", "\n").split("\n")
            if row.strip()]


def solved(matrix, right):
    """Solves linear equations by elimination with the largest pivot."""
    rows = [[*row, b] for row, b in zip(matrix, right)]
    n = len(rows)
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(k + 1, n):
            factor = rows[i][k] / rows[k][k]
            if factor:
                rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k])]
    found = [decimal.Decimal(0)] * n
    for k in reversed(range(n)):
        found[k] = (rows[k][n] - sum(rows[k][j] * found[j] for j in range(k + 1, n))) / rows[k][k]
    return found


def binomial(n, k):
    value = 1
    for i in range(k):
        value = value * (n - i) // (i + 1)
    return value


def spline_pieces(heights, values):
    """[piece, 8] coefficients of d^0 to d^7 from each node, the last one a line. The spline is a
    line below the first node, to which powers 5 to 7 are added there and the power 7 at each inner
    node; at the last node its second to fourth derivatives vanish."""
    last = heights[-1]
    terms = [(heights[0], p) for p in (0, 1, 5, 6, 7)] + [(h, DEGREE) for h in heights[1:-1]]

    def taylor(term, height, k):
        """The coefficient of d^k of a term about a height."""
        node, power = term
        if height < node or (height == node and power > 4 and k < power) or k > power:
            return decimal.Decimal(0)
        away = height - node
        return binomial(power, k) * (away ** (power - k) if power > k else decimal.Decimal(1))

    matrix = [[taylor(term, h, 0) for term in terms] for h in heights]
    matrix += [[taylor(term, last, k) for term in terms] for k in (2, 3, 4)]
    weights = solved(matrix, [*values, *[decimal.Decimal(0)] * 3])
    pieces = []
    for h in heights:
        of_node = [sum(w * taylor(t, h, k) for w, t in zip(weights, terms)) for k in range(8)]
        pieces.append(of_node if h != last else of_node[:2] + [decimal.Decimal(0)] * 6)
    return pieces


def real_rows(numbers):
    return np.array([[REAL(f"{x:.30e}") for x in row] for row in numbers], dtype=REAL)


@functools.lru_cache
def density_profiles(model):
    """[profile, node, 9]: each node's height and the coefficients of ln rho from it, in km and
    kg/m^3; the least and the greatest density, or one profile."""
    with decimal.localcontext() as context:
        context.prec = DIGITS
        if model == "exponential":
            rows = rows_of(EXPONENTIAL)
            rows.append([decimal.Decimal(1100), rows[-1][1] * (decimal.Decimal(-100) / 268).exp()])
            tables = [rows]
        else:
            rows = rows_of(HARRIS_PRIESTER)
            tables = [[[r[0], r[k] * decimal.Decimal("1e-12")] for r in rows] for k in (1, 2)]
        found = []
        for table in tables:
            heights = [row[0] for row in table]
            pieces = spline_pieces(heights, [row[1].ln() for row in table])
            found.append(real_rows([[h, *piece] for h, piece in zip(heights, pieces)]))
    return np.array(found)
