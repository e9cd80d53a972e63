# %% [markdown]
# # The paper's orbit, from scene to plot
#
# The flow about an eccentric orbit of the oblate Earth (Guibout and Bloch) as a Taylor polynomial,
# computed by a method that keeps the symplectic structure and by one that does not; deputies
# carried by the polynomial; and a rendezvous from a generating function. In a clone,
# `tools/tutorial` builds hamjet's Python package and runs all of this.

# %%
import pathlib

import matplotlib.pyplot as plt
import numpy as np

import hamjet

plots = pathlib.Path("out/paper-orbit")
plots.mkdir(parents=True, exist_ok=True)

# %% [markdown]
# ## A scene
#
# A scene is a TOML file or, here, a dict with the same keys. The unit of length is the distance at
# the start, 7000 km, and mu = 1: *canonical* units, in which all of a jet's numbers are.

# %%
scene = {
    "schema": 1,
    "title": "Earth orbit of the paper: e = 0.3, i = 60 deg, J2 and J3",
    "system": {"model": "zonal-gravity", "mu_km3_s2": 398600.4405, "radius_km": 6378.137,
               "J2": 1.082626675e-3, "J3": 2.532436e-6},
    "nominal": {"a_km": 10000, "e": 0.3, "i_deg": 60, "raan_deg": 0, "argp_deg": 0, "ta_deg": 0},
    "jet": {"order": 4, "duration_canonical": 10 * np.pi},
    "integrator": [
        {"label": "gauss8", "method": "gauss", "stages": 8, "tolerance": 1e-13},
        {"label": "fehlberg78", "method": "fehlberg78", "tolerance": 1e-8},
    ],
    "figure": {"quantity": "exactness", "kind": "F1"},
}
result = hamjet.run(scene)
assert isinstance(result, hamjet.Result)
for run in result.runs.values():
    defect = run.jet.symplecticity()["scaled"].max()
    print(f"{run.label:11} {run.summary['steps']:4} steps, symplecticity defect {defect:.1e}")

# %% [markdown]
# ## Is it the jet of a symplectic map?
#
# Only then is there a generating function. F1 takes initial and final positions; its exactness
# residual along time is the paper's figure. The dotted lines are times at which F1 does not exist.

# %%
figure, axes = plt.subplots(figsize=(8, 4))
for run in result.runs.values():
    along = run.along_time
    assert along is not None
    axes.semilogy(along.times_s / 3600, along.exactness, label=run.label)
along = result.runs["gauss8"].along_time
assert along is not None
for time in along.singular_times_canonical * result.runs["gauss8"].jet.units.time_s / 3600:
    axes.axvline(time, color="gray", linestyle=":", linewidth=0.8)
axes.set(xlabel="time (h)", ylabel="exactness residual of F1, degree 0, scaled")
axes.legend()
figure.savefig(plots / "exactness.png", dpi=120)

# %% [markdown]
# ## Deputies around a chief
#
# A hundred thousand deputies, within 1 km and 1 m/s of the nominal at the start. The jet is a
# polynomial of degree 4 in the six deviations (`jet.coefficients`, with powers `jet.exponents`),
# and is evaluated at all of them at once. How much do the degrees above the first add?

# %%
jet = result.runs["gauss8"].jet
print(jet, jet.coefficients.shape, jet.exponents.shape)
random = np.random.default_rng(1)
size = np.array([1 / jet.units.length_km] * 3 + [0.001 / jet.units.velocity_km_s] * 3)
deviations = random.normal(size=(100_000, 6))
deviations *= size / np.linalg.norm(deviations, axis=1, keepdims=True)
final = jet.evaluate(deviations)
misses = [np.linalg.norm((jet.evaluate(deviations, degree=degree) - final)[:, :3], axis=1)
          * jet.units.length_km for degree in (1, 2, 3)]

figure, axes = plt.subplots(figsize=(8, 4))
for degree, miss in enumerate(misses, start=1):
    axes.hist(np.log10(miss * 1000), bins=200, histtype="step", label=f"degree {degree}")
axes.set(xlabel="log10 of the distance from degree 4 after 8.1 h (m)", ylabel="deputies")
axes.legend()
figure.savefig(plots / "deputies.png", dpi=120)

# %% [markdown]
# ## Composition
#
# The flow there and back is the identity, to the round-off that the coefficients' size amplifies.

# %%
identity = jet.compose(jet.inverse())
miss = np.abs(identity.linear_part - np.eye(6)).max()
largest = np.abs(jet.linear_part).max()
print(f"there and back: {miss:.1e} from the identity, with coefficients up to {largest:.0f}")

# %% [markdown]
# ## From here to there
#
# The generating function of the best conditioned kind, solved for what it does not take, is the
# solution of a boundary-value problem: any initial and final position, and the velocities follow.
# `hamjet.transfer` does this for every transfer time, and proves each answer by flying it.

# %%
function = jet.invert_partially("auto")
print(function, "of", ", ".join(function.variables), "condition", round(function.condition))
print("exactness, scaled, by degree:", function.exactness["scaled"])

transfers = hamjet.transfer({
    **scene, "figure": {"quantity": "energy-error"},
    "jet": {"order": 4, "duration_orbits": 1},
    "transfer": {"frame": "RTN", "derivatives": "rotating", "count": 60, "refine": True,
                 "start": {"position_m": [0, -8000, 6000]}, "end": {"position_m": [0, -100, 0]}},
})
best = transfers.best
assert best is not None
print(f"least: {transfers.total_change_m_s[best]:.2f} m/s in "
      f"{transfers.time_s[best] / 60:.0f} min, misses by {transfers.miss_m[best]:.1e} m, "
      f"with the linear answer by {transfers.miss_m_by_order[best, 0]:.0f} m")

figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4))
away = ~transfers.near_singular
left.semilogy(transfers.time_s[away] / 60, transfers.total_change_m_s[away], ".-")
left.plot(transfers.time_s[best] / 60, transfers.total_change_m_s[best], "o")
left.set(xlabel="transfer time (min)", ylabel="velocity change (m/s)")
times, states = transfers.trajectory(best)
right.plot(states[:, 1] / 1000, states[:, 0] / 1000)
right.plot(states[[0, -1], 1] / 1000, states[[0, -1], 0] / 1000, "o")
right.set(xlabel="along the motion, T (km)", ylabel="radially outward, R (km)")
figure.tight_layout()
figure.savefig(plots / "transfer.png", dpi=120)
print("plots:", *sorted(str(plot) for plot in plots.glob("*.png")))
