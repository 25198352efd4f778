# %% [markdown]
# # A hammer test, and the model fitted to it
#
# FRFs of a rig whose housings are softer than its model says, with noise; the modes in them, and the stiffness that explains them.

# %%
import warnings

import numpy as np
import rotordyn as rd

warnings.simplefilter("ignore")
rig = rd.load("../../models/overhung_rig.toml")
truth = rig.with_changes({"housing.A.k_x": "5e6 N/m", "housing.B.k_x": "5e6 N/m"})
frf = truth.frf(speed="0 rpm", refine=False)
print(frf.responses, frf.excitations)

# %% [markdown]
# A measurement in arrays: points, directions, a unit. With files of your own this is `rd.identify("test.uff")`.

# %%
places = {"A_ax": "housing.A x", "A_ay": "housing.A y", "B_ax": "housing.B x", "B_ay": "housing.B y", "disc_x": "disc.main x"}
values = np.array([[frf[name, "housing_B"]] for name in places])
rng = np.random.default_rng(7)
noise = rng.standard_normal(values.shape) + 1j * rng.standard_normal(values.shape)
level = 0.01 * np.sqrt(np.mean(abs(values) ** 2, axis=2, keepdims=True))
test = rd.Measurement(frf.frequency_hz, values + level * noise, list(places.values()), ["housing.B x"], unit="(m/s^2)/N")
modes = rd.identify(test, model=rig, band="20 .. 320 Hz")
for hz, error, zeta in zip(modes.frequency_hz, modes.modes["frequency_error_hz"], modes.zeta):
    print(f"{hz:8.3f} Hz +- {error:.4f}, damping {100 * zeta:.2f} %")

# %%
modes.plot()

# %% [markdown]
# Which stiffness do the housings have? Both are free; a parameter that the data do not determine would keep its value.

# %%
free = ["housing.A.k_x", "housing.B.k_x"]
found = rd.update(rig, test, free, fit=["frequency"], band="20 .. 320 Hz")
for row in found.parameters:
    print(f"{row['name']}: {row['start']:.3g} -> {row['value']:.4g} {row['unit']}, {row['identifiability']}")

# %%
before, after, measured = (m.modal(speed="0 rpm", modes=8).frequency_hz for m in (rig, found.model, truth))
print(np.round([before, after, measured], 2))
assert abs(after / measured - 1.0)[:6].max() < 0.2 * abs(before / measured - 1.0)[:6].max()

# %% [markdown]
# Measured, computed before and after:

# %%
found.plot()
