"""Orbits and frames of the attack, from their definitions, in long double."""
import numpy as np

from flight import PI, REAL


def dot(a, b):
    return np.sum(a * b, axis=-1)


def norm(a):
    return np.sqrt(dot(a, a))


def eccentric_anomaly(mean, e):
    """Kepler's equation by bisection, then Newton's method."""
    mean = np.remainder(REAL(mean) + PI, 2 * PI) - PI
    low, high = mean - e, mean + e
    for _ in range(20):
        middle = (low + high) / 2
        if middle - e * np.sin(middle) < mean:
            low = middle
        else:
            high = middle
    E = (low + high) / 2
    for _ in range(8):
        E -= (E - e * np.sin(E) - mean) / (1 - e * np.cos(E))
    return E


def true_of_eccentric(E, e):
    return 2 * np.arctan2(np.sqrt(1 + e) * np.sin(E / 2), np.sqrt(1 - e) * np.cos(E / 2))


def eccentric_of_true(nu, e):
    return 2 * np.arctan2(np.sqrt(1 - e) * np.sin(nu / 2), np.sqrt(1 + e) * np.cos(nu / 2))


def degrees(x):
    return REAL(x) * PI / 180


def state_of(mu, a, e, i, node, w, nu):
    """Elements in metres and radians."""
    a, e, i, node, w, nu = (REAL(x) for x in (a, e, i, node, w, nu))
    p = a * (1 - e * e)
    r, speed = p / (1 + e * np.cos(nu)), np.sqrt(mu / p)
    c, s = np.cos(node), np.sin(node)
    ci, si = np.cos(i), np.sin(i)
    ahead = np.array([c * np.cos(w) - s * np.sin(w) * ci, s * np.cos(w) + c * np.sin(w) * ci,
                      np.sin(w) * si])
    across = np.array([-c * np.sin(w) - s * np.cos(w) * ci, -s * np.sin(w) + c * np.cos(w) * ci,
                       np.cos(w) * si])
    return np.concatenate([r * (np.cos(nu) * ahead + np.sin(nu) * across),
                           speed * (-np.sin(nu) * ahead + (e + np.cos(nu)) * across)])


def elements_of(mu, state):
    """a, q1 = e cos w, q2 = e sin w, i, node, true argument of latitude, w + M."""
    x, v = state[:3], state[3:]
    h = np.cross(x, v)
    r = norm(x)
    a = 1 / (2 / r - dot(v, v) / mu)
    to_node = np.array([-h[1], h[0], REAL(0)])
    to_node /= norm(to_node)
    beside = np.cross(h / norm(h), to_node)
    vector = np.cross(v, h) / mu - x / r
    q1, q2 = dot(vector, to_node), dot(vector, beside)
    theta = np.arctan2(dot(x, beside), dot(x, to_node))
    e, w = np.sqrt(q1 * q1 + q2 * q2), np.arctan2(q2, q1)
    E = eccentric_of_true(theta - w, e)
    return {"a": a, "q1": q1, "q2": q2, "i": np.arctan2(np.hypot(h[0], h[1]), h[2]),
            "node": np.arctan2(h[0], -h[1]), "theta": theta, "u": w + E - e * np.sin(E)}


def eccentricity(mu, state):
    x, v = state[:3], state[3:]
    return norm(np.cross(v, np.cross(x, v)) / mu - x / norm(x))


def perigee(mu, state):
    h = np.cross(state[:3], state[3:])
    return dot(h, h) / mu / (1 + eccentricity(mu, state))


def anomalies(mu, state):
    """a, e, true and mean anomaly."""
    x, v = state[:3], state[3:]
    r, e = norm(x), eccentricity(mu, state)
    a = 1 / (2 / r - dot(v, v) / mu)
    E = np.arctan2(dot(x, v) / np.sqrt(mu * a), 1 - r / a)
    return a, e, true_of_eccentric(E, e), E - e * np.sin(E)


def state_of_nonsingular(mu, a, q1, q2, i, node, theta=None, u=None):
    e, w = np.sqrt(q1 * q1 + q2 * q2), np.arctan2(q2, q1)
    nu = theta - w if theta is not None else true_of_eccentric(eccentric_anomaly(u - w, e), e)
    return state_of(mu, a, e, i, node, w, nu)


def axes_of(chief):
    """Rows R, T, N, and the rate of the osculating orbit."""
    x, v = chief[:3], chief[3:]
    h = np.cross(x, v)
    R, N = x / norm(x), h / norm(h)
    return np.array([R, np.cross(N, R), N]), norm(h) / dot(x, x)


def to_frame(chief, deviation, frame, derivatives):
    """A deviation (position, velocity; inertial) along the axes of a frame at the chief; of many
    deviations [..., 6]."""
    if frame == "inertial":
        return np.array(deviation, dtype=REAL)
    axes, rate = axes_of(chief)
    x, v = deviation[..., :3] @ axes.T, deviation[..., 3:] @ axes.T
    if derivatives != "inertial":
        v = v - np.cross(np.array([0, 0, rate], dtype=REAL), x)
    return np.concatenate([x, v], axis=-1)


def from_frame(chief, state, frame, derivatives):
    state = np.array(state, dtype=REAL)
    if frame == "inertial":
        return state
    axes, rate = axes_of(chief)
    x, v = state[..., :3], state[..., 3:]
    if derivatives != "inertial":
        v = v + np.cross(np.array([0, 0, rate], dtype=REAL), x)
    return np.concatenate([x @ axes, v @ axes], axis=-1)


def wrapped(angle):
    return np.remainder(angle + PI, 2 * PI) - PI


CURVILINEAR = ["radial_m", "arc_m", "cross_m", "radial_rate_m_s", "arc_rate_m_s",
               "cross_rate_m_s"]
RELATIVE_ELEMENTS = ["a_da_m", "a_dlambda_m", "a_dex_m", "a_dey_m", "a_dix_m", "a_diy_m"]
ELEMENT_DIFFERENCES = ["da_m", "dtheta_deg", "di_deg", "dq1", "dq2", "draan_deg"]
FORMS = {"curvilinear": CURVILINEAR, "relative-elements": RELATIVE_ELEMENTS,
         "element-differences": ELEMENT_DIFFERENCES}


def from_form(mu, chief, form, numbers):
    """The deputy's own inertial state."""
    numbers = [REAL(x) for x in numbers]
    if form == "curvilinear":
        axes, rate = axes_of(chief)
        r = norm(chief[:3])
        r_rate = dot(chief[:3], chief[3:]) / r
        radius = r + numbers[0]
        angle, out = numbers[1] / r, numbers[2] / r
        # arc = r times the angle, so that arc' = r' angle + r angle'; the chief itself turns.
        turn = (numbers[4] - r_rate * angle) / r + rate
        lift = (numbers[5] - r_rate * out) / r
        c, s, co, so = np.cos(angle), np.sin(angle), np.cos(out), np.sin(out)
        unit = np.array([co * c, co * s, so])
        ahead, up = np.array([-s, c, REAL(0)]), np.array([-so * c, -so * s, co])
        velocity = (r_rate + numbers[3]) * unit + radius * (turn * co * ahead + lift * up)
        return np.concatenate([(radius * unit) @ axes, velocity @ axes])
    k = elements_of(mu, chief)
    if form == "relative-elements":
        d = [x / k["a"] for x in numbers]
        node = d[5] / np.sin(k["i"])
        return state_of_nonsingular(mu, k["a"] + numbers[0], k["q1"] + d[2], k["q2"] + d[3],
                                    k["i"] + d[4], k["node"] + node,
                                    u=k["u"] + d[1] - node * np.cos(k["i"]))
    return state_of_nonsingular(mu, k["a"] + numbers[0], k["q1"] + numbers[3],
                                k["q2"] + numbers[4], k["i"] + degrees(numbers[2]),
                                k["node"] + degrees(numbers[5]),
                                theta=k["theta"] + degrees(numbers[1]))


def to_form(mu, chief, deputy, form):
    if form == "curvilinear":
        axes, rate = axes_of(chief)
        r = norm(chief[:3])
        r_rate = dot(chief[:3], chief[3:]) / r
        x, v = axes @ deputy[:3], axes @ deputy[3:]
        radius, flat = norm(x), np.hypot(x[0], x[1])
        angle, out = np.arctan2(x[1], x[0]), np.arctan2(x[2], flat)
        turn = (x[0] * v[1] - x[1] * v[0]) / flat ** 2 - rate
        flat_rate = (x[0] * v[0] + x[1] * v[1]) / flat
        lift = (v[2] * flat - x[2] * flat_rate) / radius ** 2
        return np.array([radius - r, r * angle, r * out, dot(x, v) / radius - r_rate,
                         r_rate * angle + r * turn, r_rate * out + r * lift])
    k, d = elements_of(mu, chief), elements_of(mu, deputy)
    node = wrapped(d["node"] - k["node"])
    if form == "relative-elements":
        return np.array([d["a"] - k["a"],
                         k["a"] * (wrapped(d["u"] - k["u"]) + node * np.cos(k["i"])),
                         k["a"] * (d["q1"] - k["q1"]), k["a"] * (d["q2"] - k["q2"]),
                         k["a"] * (d["i"] - k["i"]), k["a"] * node * np.sin(k["i"])])
    turn = 180 / PI
    return np.array([d["a"] - k["a"], wrapped(d["theta"] - k["theta"]) * turn,
                     (d["i"] - k["i"]) * turn, d["q1"] - k["q1"], d["q2"] - k["q2"], node * turn])
