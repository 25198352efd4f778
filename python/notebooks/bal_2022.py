# %% [markdown]
# # Preloaded angular-contact bearings (Bal et al. 2022)
#
# A rigid shaft on two FAG 7206 back to back: how does the radial natural frequency follow the preload? The paper has 833.1 Hz at
# 50 N and 918.5 Hz at 150 N, at 1400 rpm; its own Appendix E would give a ratio of 1.20.

# %%
import warnings

import rotordyn as rd

warnings.simplefilter("ignore")
rotor = rd.load("../../models/bal_2022.toml")

# %%
def radial(variant: str) -> float:
    """The lowest natural frequency [Hz] of a radial motion at 1400 rpm."""
    modes = rotor.variant(variant).modal(speed="1400 rpm", modes=6)
    return min(float(hz) for hz, label in zip(modes.frequency_hz, modes.label) if "axial" not in label)


found = {preload: radial(f"preload_{preload}") for preload in (20, 50, 100, 150, 200, 500)}
for preload, hz in found.items():
    print(f"{preload:4d} N: {hz:7.1f} Hz")
ratio = found[150] / found[50]
print(f"ratio of 150 N to 50 N: {ratio:.4f}; the paper has 1.1025")
assert 1.05 < ratio < 1.2 and list(found.values()) == sorted(found.values())

# %% [markdown]
# With a prescribed axial force instead of an interference the frequency rises faster, nearer to the law of Appendix E,
# frequency ~ force^(1/6).

# %%
force = {n: radial(f"force_{n}") for n in (50, 100, 200, 500)}
print({n: round(hz, 1) for n, hz in force.items()}, f"ratio {force[500] / force[50]:.3f}, law {10 ** (1 / 6):.3f}")

# %%
rotor.variant("preload_150").campbell(max_speed="5000 rpm").plot()
