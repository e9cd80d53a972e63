# %% [markdown]
# # An orbit from keyword arguments
#
# A low orbit of the oblate Earth, without a file: its jet, deputies around it, a transfer between
# two of their places and how far from the chief all of this is right. It needs pandas and
# matplotlib beside hamjet.

# %%
import numpy as np

import hamjet

# %% [markdown]
# ## The orbit
#
# The keywords are the keys of a scene (`help(hamjet.orbit)` lists them; the unit is in the key's
# name). The Earth's mu and radius, and the angles, are filled in; what comes out is the scene as
# a dict.

# %%
scene = hamjet.orbit(a_km=7078, e=0.001, i_deg=98, J2=1.08262668e-3, order=4, duration_orbits=0.8)
print(scene)
jet = hamjet.run(scene).runs["gauss8"].jet
print(jet, f"over {jet.duration_s / 60:.0f} min")

# %% [markdown]
# A slip is answered with what would be right.

# %%
try:
    hamjet.orbit(a_km=7078, e=0.001, i_deg=98, order=4, duration_orbit=0.8)
except hamjet.SceneError as error:
    print(error)

# %% [markdown]
# ## Deputies
#
# Relative states (radial, transverse, normal) at the end, with an estimate of the miss of each,
# as a data frame with the columns that `hamjet eval` has.

# %%
behind = np.zeros((4, 6))
behind[:, 1] = [-100, -1000, -10_000, -100_000]
final = jet.evaluate_relative(behind)
print(final.to_dataframe().round(3).to_string())

# %% [markdown]
# ## Derivatives, composition, files
#
# About a deputy's own trajectory the state transition matrix is another: the Jacobian there. The
# flow there and back is the identity. A file keeps every bit, for the command too.

# %%
deviation = np.zeros(6)
deviation[1] = 10 / jet.units.length_km
change = np.abs(jet.jacobian(deviation) - jet.linear_part).max() / np.abs(jet.linear_part).max()
print(f"10 km away the state transition matrix differs by {change:.1e} of its largest element")
there_and_back = jet.inverse() @ jet
miss = np.abs(there_and_back.linear_part - np.eye(6)).max()
print(f"there and back: {miss:.1e} from the identity")
again = hamjet.Jet.from_arrays(jet.coefficients, jet.exponents, model=jet.model, units=jet.units,
                               nominal_initial=jet.nominal_initial,
                               duration_canonical=jet.duration_canonical)
assert (again(deviation) == jet(deviation)).all()

# %% [markdown]
# ## A transfer
#
# From 1 km behind to 100 m behind, for 40 transfer times: one row each. Dotted lines in the plot
# are times at which positions cannot be commanded.

# %%
places = {"frame": "RTN", "derivatives": "rotating"}
transfers = hamjet.transfer({**scene, "transfer": {
    **places, "count": 40,
    "start": {"position_m": [0, -1000, 0]}, "end": {"position_m": [0, -100, 0]}}})
shown = ["time_s", "kind", "near_singular", "total_change_m_s", "miss_m_order_1", "miss_m_order_4"]
print(transfers.to_dataframe()[shown].iloc[::8].to_string())
transfers.plot().set_title("1 km to 100 m behind");

# %% [markdown]
# ## How far it is right
#
# The separations up to which the polynomials of each order miss by less than a metre, proved by
# flying deputies.

# %%
validity = hamjet.validity({**scene, "validity": {**places, "count": 8, "tolerance_m": 1}})
validity.plot().set_title("within 1 m");
