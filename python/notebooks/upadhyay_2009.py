# %% [markdown]
# # Off-size balls (Upadhyay et al. 2009)
#
# A rigid rotor at 5000 rpm on one bearing whose balls have a radial degree of freedom each. With perfect balls the motion is at the
# ball-pass frequency or half of it; two balls larger by 0.2 um bring lines of the cage.

# %%
import os
import warnings

import numpy as np
import rotordyn as rd

warnings.simplefilter("ignore")
machine = rd.load("../../models/upadhyay_2009.toml")
long = "ROTORDYN_LONG" in os.environ


def lines(model: rd.Model) -> tuple[float, float]:
    """Frequency [Hz] and amplitude of the highest line of the second half of a run."""
    if not long:
        model["speed.duration"] = "0.4 s"
    run = model.run_up()
    name = next(iter(run.channels))
    samples = run[name][len(run.time) // 2 :]
    rate = 1.0 / float(np.mean(np.diff(run.time)))
    spectrum = abs(np.fft.rfft((samples - samples.mean()) * np.hanning(len(samples))))
    k = int(spectrum[2:].argmax()) + 2
    return k * rate / len(samples), float(spectrum[k] * 4.0 / len(samples))


# %%
cage = 33.223  # Hz at 5000 rpm
for name in ("balls_9", "off_size_9") if not long else ("balls_7", "balls_8", "balls_9", "balls_11", "balls_13", "off_size_13"):
    balls = int(name.split("_")[-1])
    hz, level = lines(machine.variant(name))
    print(f"{name}: highest line {hz:.1f} Hz = {hz / cage:.2f} times the cage, ball pass {balls * cage:.1f} Hz, {level:.2e}")
    assert 0.0 < hz < 3000.0
