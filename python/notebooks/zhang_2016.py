# %% [markdown]
# # Stiffness of a lubricated deep-groove bearing (Zhang et al. 2016)
#
# What does the film change in the radial stiffness? The paper's fitted laws, dry and lubricated at rolling speeds of 10 and 30 m/s,
# are variants of the model.

# %%
import warnings

import rotordyn as rd

warnings.simplefilter("ignore")
machine = rd.load("../../models/zhang_2016.toml")

# %%
stiffness = {}
for law in ("dry10", "ehl10", "dry30", "ehl30"):
    for load in (2000, 4000):
        k = machine.variant(law).bearing("A").stiffness(load=f"{load}, 0, 0 N")
        stiffness[law, load] = k[0, 0]
        print(f"{law}, {load} N: k_xx = {k[0, 0]:.4e} N/m")

# %% [markdown]
# Relative to the dry bearing: some per cent, as in section 5.1.

# %%
for speed in (10, 30):
    for load in (2000, 4000):
        change = stiffness[f"ehl{speed}", load] / stiffness[f"dry{speed}", load] - 1.0
        print(f"{speed} m/s, {load} N: {100 * change:+.1f} %")
        assert abs(change) < 0.2

# %%
found = machine.bearing("A").analyse(load="2000, 0, 0 N", sweep=["load=200 N .. 4 kN"], along="x")
found.plot()
