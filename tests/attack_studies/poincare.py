"""hamjet poincare: the frozen orbit is flown over its nodal period, and its multipliers are found
by differences of flights."""
import numpy as np

import orbit
from command import Run
from flight import REAL
from refusal import results


def draw(source):
    scene = source.scene(revolutions=(0.5, 1), orders=(2, 4), weights=(3, 2), largest_e=0.3,
                  coordinates=False, may_go_back=False)
    return scene


def is_kepler(scene):
    return scene.highest == 0


def judge(judgement, scene, folder):
    run = Run(folder, ["poincare", "scene.toml", "-o", "out"], limit=120)
    summary = results(judgement, scene, run, [
        (r"frozen|J2|zonal|kepler", is_kepler),
        (r"frozen orbit: none|not found|divisor|node", lambda s: True)])
    if summary is None:
        return
    frozen = summary["frozen_orbit"]
    units = np.array([scene.length] * 3 + [scene.length / scene.time_unit] * 3)
    # The state is told in doubles.
    state = np.array(frozen["state_canonical"], dtype=REAL) * units
    period = REAL(frozen["nodal_period_s"])
    end = scene.field.to(state, period)
    rounding = 1e-14 * float(orbit.norm(state[:3])) * 30
    before, after = meridian(state), meridian(end)
    judgement.within("the frozen orbit after a nodal period, in its meridian (m)", after[:2],
                     before[:2], rounding)
    judgement.within("the same, velocities (m/s)", after[2:], before[2:],
                     rounding * float(scene.rate) * 3)
    turn = orbit.wrapped(np.arctan2(end[1], end[0]) - np.arctan2(state[1], state[0]))
    judgement.within("turn of the node (degrees)", frozen["node_deg_per_revolution"],
                     float(turn * 180 / orbit.PI) if abs(np.cos(scene.i)) < 2 else 0, 1e-7)
    k = orbit.elements_of(scene.mu, state)
    judgement.within("semi-major axis (km)", frozen["a_km"], k["a"] / 1000, 1e-9 * k["a"] / 1000)
    judgement.within("eccentricity", frozen["e"], np.hypot(k["q1"], k["q2"]), 1e-9)
    judgement.within("inclination (degrees)", frozen["i_deg"], k["i"] * 180 / orbit.PI, 1e-8)
    lowest = k["a"] * (1 - np.hypot(k["q1"], k["q2"]))
    if abs(lowest / scene.radius - 1) > 0.02:
        judgement.require("inside the body is told", frozen["inside_body"]
                          == bool(lowest < scene.radius))
    # The chief's own constants.
    ratio = energy(scene, state) / energy(scene, scene.chief)
    judgement.within("energy, relative", float(ratio), 1, 1e-11)
    whole = orbit.norm(np.cross(state[:3], state[3:]))
    judgement.within("momentum about the axis, of the whole",
                     float(momentum(state) / whole), float(momentum(scene.chief) / whole), 1e-11)
    trace_less_2 = trace_of_return(scene, state, period)
    told = frozen["trace_less_2"]
    judgement.note("poincare: trace", abs(told / trace_less_2 - 1) if trace_less_2 else 0)
    judgement.within("trace less 2", told, trace_less_2, 1e-3 * abs(told) + 1e-9)


def meridian(state):
    x, y, z, vx, vy, vz = state
    rho = np.hypot(x, y)
    return np.array([rho, z, (x * vx + y * vy) / rho, vz])


def energy(scene, state):
    return potential(scene, state[:3]) + np.dot(state[3:], state[3:]) / 2


def potential(scene, x):
    r = orbit.norm(x)
    s = x[2] / r
    before, legendre, total = REAL(1), s, REAL(1)
    for n in range(2, scene.highest + 1):
        before, legendre = legendre, ((2 * n - 1) * s * legendre - (n - 1) * before) / n
        total -= scene.field.zonals[n] * (scene.radius / r) ** n * legendre
    return -scene.mu / r * total


def momentum(state):
    return state[0] * state[4] - state[1] * state[3]


def trace_of_return(scene, state, period):
    """The sum of the two multipliers of the motion in the meridian plane that are not 1, less 2:
    of the flow's 6 x 6 matrix, whose others are the turn's and time's two pairs of 1."""
    matrix = scene.field.transition(state, period)
    # Taken into axes that have turned with the node.
    end = scene.field.to(state, period)
    angle = np.arctan2(state[1], state[0]) - np.arctan2(end[1], end[0])
    c, s = np.cos(angle), np.sin(angle)
    turn = np.eye(6, dtype=REAL)
    for k in (0, 3):
        turn[k:k + 2, k:k + 2] = [[c, -s], [s, c]]
    return float(np.trace(turn @ matrix) - 6)
