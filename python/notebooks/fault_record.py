# %% [markdown]
# # A fault in a record
#
# The motor rig of the CWRU bearing data, simulated with a fault in its inner race; a measured record is used in the same way.

# %%
import warnings

import numpy as np
import rotordyn as rd

warnings.simplefilter("ignore")
motor = rd.load("../../models/cwru_6205.toml", variant="inner_race")
motor["speed.duration"] = "1.2 s"
run = motor.run_up()
rate = 1.0 / float(np.mean(np.diff(run.time)))
x = run["DE"][run.time >= 0.25]
print(f"{len(x)} samples at {rate:.0f} Hz")

# %%
found = rd.signal.diagnose(x, fs=rate, bearing="6205", speed="1797 rpm", unit=run.channels["DE"], name="DE")
found.plot()

# %%
print(found.envelope.diagnosis)
assert "inner" in str(found.to_dict()).lower()
