# %% [markdown]
# # Dents and bumps in a race (Atef et al. 2022)
#
# A 6205 with defects of 0.17 mm at 1797 rpm. A ball needs 96.55 us to pass one; the impacts repeat with the ball-pass frequency of
# the outer race.

# %%
import os
import warnings

import numpy as np
import rotordyn as rd

warnings.simplefilter("ignore")
machine = rd.load("../../models/atef_2022.toml")
orders = machine.bearing("B").analyse().nominal_orders
print({name: round(float(orders[name]), 4) for name in orders.keys()})

# %%
variant = machine.variant("one_dent")
if "ROTORDYN_LONG" not in os.environ:
    variant["speed.duration"] = "0.15 s"
run = variant.run_up()
{name: unit for name, unit in list(run.channels.items())[:8]}

# %% [markdown]
# The envelope of the resonator's acceleration has the line of the outer race. A diagnosis needs ten turns of the cage, about a
# second: the whole run of the file, with `ROTORDYN_LONG`.

# %%
channel = next(name for name, unit in run.channels.items() if unit == "m/s^2")
rate = 1.0 / float(np.mean(np.diff(run.time)))
bpfo = float(orders["bpfo"]) * 1797 / 60
x = run[channel] - run[channel].mean()
envelope = abs(np.fft.ifft(np.fft.fft(x) * np.r_[1.0, np.full((len(x) - 1) // 2, 2.0), np.zeros(len(x) - 1 - (len(x) - 1) // 2)]))
spectrum = abs(np.fft.rfft((envelope - envelope.mean()) * np.hanning(len(x))))
bins = np.round(np.arange(1, 6) * bpfo * len(x) / rate).astype(int)
lines = [spectrum[k - 1 : k + 2].max() for k in bins]
print(f"BPFO {bpfo:.1f} Hz, {len(x)} samples at {rate:.0f} Hz; its lines over the median: {np.round(lines / np.median(spectrum[: bins[-1]]))}")
assert max(lines) > 5.0 * np.median(spectrum[: bins[-1]])

# %%
if run.time[-1] > 1.1:
    found = rd.signal.diagnose(run[channel], fs=rate, bearing="6205", speed="1797 rpm", unit="m/s^2", name=channel)
    print(found.envelope.diagnosis)
