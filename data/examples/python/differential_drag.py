# %% [markdown]
# # A rendezvous without propellant
#
# Two identical cubesats fly 420 km up, one 10 km behind the other. The one behind turns its panels
# across the motion, falls below its chief and catches up; then it turns them along the motion until
# both orbits are as high again. When to turn, and when to be back in the chief's own attitude,
# follows from one jet about the chief, in positions, momenta and C_D A / m, at any time of its flight.

# %%
import datetime

import numpy as np

import hamjet

CHIEF, TURN = 0.02, 0.009  # C_D A / m of the chief, and what turned panels add or take away, m^2/kg
EPOCH = datetime.datetime(2026, 3, 1, 6)
BEHIND_M = 10e3


def scene(drag_m2_kg, after_s=0.0, **nominal):
    """An orbit that stands at its nominal so long after the epoch."""
    epoch = EPOCH + datetime.timedelta(seconds=after_s)
    return {"system": {"model": "earth", "atmosphere": "harris-priester"},
            "spacecraft": {"drag_m2_kg": drag_m2_kg},
            "nominal": {"epoch_tt": epoch.isoformat(), **nominal}}


def followed(drag_m2_kg, days, after_s=0.0, **nominal):
    """The jet at any time about an orbit."""
    variables = ["x", "y", "z", "px", "py", "pz", "drag_m2_kg"]
    return hamjet.trajectory({**scene(drag_m2_kg, after_s, **nominal), "jet": {
        "order": 4, "duration_s": days * 86400, "variables": variables}})


def units(jet):
    """Kilometres, and kilometres a second, of the canonical units of a jet's states."""
    return np.repeat([jet.units.length_km, jet.units.length_km / jet.units.time_s], 3)


def state_of(jet):
    return jet.nominal_final[:6] * units(jet)


track = followed(CHIEF, 3, height_km=420, i_deg=97.5, raan_deg=30, u_deg=0)
chief = state_of(track.at(0))

# %% [markdown]
# The deputy starts on its chief's orbit, 10 km behind: the chief's state turned back about the normal
# of its orbit. Deviations are in km and km/s.

# %%
q, p = np.split(chief, 2)
normal = np.cross(q, p) / np.linalg.norm(np.cross(q, p))
angle = -BEHIND_M / 1000 / np.linalg.norm(q)


def turned(v):
    return v * np.cos(angle) + np.cross(normal, v) * np.sin(angle)


deviation = np.concatenate([turned(q), turned(p)]) - chief


def flow(jet, deviation, drag):
    """What a jet makes of a deviation, with panels that are turned."""
    return jet.evaluate(np.append(deviation / units(jet), drag)[None])[0, :6] * units(jet)


def back(jet, there, drag):
    """The deviation of which a jet makes this one, by Newton's method."""
    found = np.zeros(6)
    for _ in range(6):
        linear = jet.jacobian(np.append(found, drag)[None])[0, :6, :6]
        miss = (flow(jet, found * units(jet), drag) - there) / units(jet)
        found = found - np.linalg.solve(linear, miss)
    return found * units(jet)


def along_m(jet, z):
    velocity = state_of(jet)[3:]
    return 1000 * z[:3] @ velocity / np.linalg.norm(velocity)


# %% [markdown]
# For a constant deceleration f the panels stay across for sqrt(distance / (3 f)), and along for as
# long. The jet itself tells f: 3/2 f t^2 is how far turned panels lead in half a day. The second part is
# told by a jet about the chief from a little before the first turn.

# %%
half_day = 43200.0
f = along_m(track.at(half_day), flow(track.at(half_day), np.zeros(6), TURN)) / 1.5 / half_day**2
turns_s = np.sqrt(BEHIND_M / (3 * f)) * np.array([1.0, 2.0])
later_s = float(np.round(0.9 * turns_s[0]))
middle = state_of(track.at(later_s))
later = followed(CHIEF, 2, later_s, position_km=list(middle[:3]), velocity_km_s=list(middle[3:]))


def predicted(turns_s):
    """The deviation after the panels were across until the first time, along until the second."""
    first, second = turns_s
    there = flow(track.at(first), deviation, TURN)
    between = back(later.at(first - later_s), there, -TURN)
    return flow(later.at(second - later_s), between, -TURN)


# %% [markdown]
# Two conditions for two times, by Newton's method: no distance along the motion, and the same
# semi-major axis.

# %%
def conditions(turns_s):
    z = predicted(turns_s)
    jet = track.at(turns_s[1])
    axes = hamjet.elements_of_states(np.array([state_of(jet), state_of(jet) + z]),
                                     mu_km3_s2=398600.4415)[:, 0]
    return np.array([along_m(jet, z), 1000 * (axes[1] - axes[0])])


for _ in range(6):
    slope = np.array([conditions(turns_s + h) - conditions(turns_s - h)
                      for h in 60 * np.eye(2)]).T / 120
    turns_s = turns_s - np.linalg.solve(slope, conditions(turns_s))
turns_s = np.round(turns_s)  # commands go by whole seconds
print(f"panels across for {turns_s[0] / 3600:.2f} h, along until {turns_s[1] / 3600:.2f} h")

# %% [markdown]
# Flown: each part is a scene of its own, with its own C_D A / m and no jet in it.


# %%
def flown(state, drag, after_s, duration_s):
    told = {"position_km": list(state[:3]), "velocity_km_s": list(state[3:])}
    one = {**scene(drag, after_s, **told), "jet": {"order": 1, "duration_s": duration_s}}
    return state_of(hamjet.run(one).runs["gauss8"].jet)


halfway = flown(chief + deviation, CHIEF + TURN, 0, turns_s[0])
end = flown(halfway, CHIEF - TURN, turns_s[0], turns_s[1] - turns_s[0])
there = end - flown(chief, CHIEF, 0, turns_s[1])
miss_m = 1000 * np.linalg.norm((there - predicted(turns_s))[:3])
separation_m = 1000 * np.linalg.norm(there[:3])
print(f"flown, it ends {separation_m:.1f} m from its chief; the jets are right to {miss_m:.2g} m")
assert separation_m < 20 and miss_m < 1
