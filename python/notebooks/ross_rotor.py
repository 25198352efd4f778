# %% [markdown]
# # Your ROSS rotor with real bearings
#
# A rotor that ROSS saved is read, gives the numbers of ROSS, and then gets ball bearings of the catalogue in place of constant
# coefficients.

# %%
import json
import warnings
from pathlib import Path

import numpy as np
import rotordyn as rd

FOLDER = Path("../../tests/data/ross/rotors")
with warnings.catch_warnings(record=True) as given:
    warnings.simplefilter("always")
    rotor = rd.from_ross(FOLDER / "example_rotor.toml")  # or rd.from_ross(rotor) of a ross.Rotor
print(rotor)
for warning in given:
    print(warning.message)
warnings.simplefilter("ignore")

# %% [markdown]
# ## The same numbers
#
# Eigenvalues that ROSS 3.1 computed with its own matrices, beside those of the model.

# %%
figures = json.loads((FOLDER / "figures.json").read_text())["rotors"]["example_rotor.toml"]
row = figures["eigenvalues"][1]
speed = row["speed"]                                     # rad/s
expected = np.array(row["re"]) + 1j * np.array(row["im"])
modes = rotor.modal(speed=f"{speed} rad/s", modes=20)
difference = [np.min(abs(modes.eigenvalue - value)) / abs(value) for value in expected]
print(f"{len(expected)} eigenvalues at {speed} rad/s agree to {max(difference):.1e}")
assert max(difference) < 1e-6

# %%
rotor.campbell(max_speed="6000 rpm").plot()

# %% [markdown]
# ## Ball bearings
#
# The shaft is 50 mm thick: a 6210 fits. Which stiffness does it have? That depends on its load.

# %%
names = [name for name in rotor.to_dict()["bearing"]]
ball = {"model": "ball", "designation": "6210"}
real = rotor.with_changes({f"bearing.{name}": {"station": rotor[f"bearing.{name}.station"], **ball} for name in names})
for load in ("0, -100, 0 N", "0, -500, 0 N", "0, -2000, 0 N"):
    k = real.bearing(names[0]).stiffness(load=load)
    print(f"{load:>14}: k_xx = {k[0, 0]:.3g} N/m, k_yy = {k[1, 1]:.3g} N/m")

# %% [markdown]
# It is softer across the load than along it, and stiffer the more it carries: one number, as in the rotor above, is neither.
# What changes in the machine:

# %%
for title, model in (("constant 1e6 N/m", rotor), ("6210", real)):
    found = model.modal(speed="0 rpm", modes=4)
    print(f"{title:>18}: {np.round(found.frequency_hz, 2)} Hz")
at_rest = real.bearing(names[0]).stiffness(speed="0 rpm")
print(f"stiffness at rest: x {at_rest[0, 0]:.3g}, y {at_rest[1, 1]:.3g} N/m")
assert at_rest[1, 1] > 5e6

# %% [markdown]
# And back: the linear part of the machine as a `ross.Rotor`, with a warning for each part that ROSS cannot have.

# %%
try:
    import ross  # noqa: F401
except ImportError:
    print("pip install ross-rotordynamics for this cell")
else:
    back = real.to_ross(["0 rpm", "3000 rpm", "6000 rpm"])
    print(back)
