"""scipy's splines and numpy's differences, for tests/signal/oracle_resampling.rs.

python3 oracle_resampling.py > ../data/scipy_resampling.json
"""

import json

import numpy as np
from scipy import signal
from scipy.interpolate import CubicSpline, PchipInterpolator


def noise(seed, n):
    """The generator of tests/signal/main.rs."""
    state, out = seed, []
    for _ in range(n):
        state = (state * 1664525 + 1013904223) % 2**32
        out.append(state / 2.0**31 - 1.0)
    return np.array(out)


# Nonuniform time steps between 0.6 and 1.4 ms; a record at these times.
step = 1e-3 * (1.0 + 0.4 * noise(11, 200))
time = np.concatenate([[0.25], 0.25 + np.cumsum(step)])
record = noise(12, 201)
rate = 1300.0
count = int(np.floor((time[-1] - time[0]) * rate)) + 1
grid = time[0] + np.arange(count) / rate
spline = CubicSpline(time, record, bc_type="natural")(grid)

# Pulses of a shaft that runs up, and its angle between them.
pulses = np.sqrt(np.arange(1, 40)) * 0.1 + 0.002 * noise(13, 39)
sampled = np.arange(int(np.ceil(pulses[0] * 2000.0)), int(np.floor(pulses[-1] * 2000.0)) + 1) / 2000.0
angle = 2.0 * np.pi * PchipInterpolator(pulses, np.arange(39))(sampled)

# Envelope of a band: zero-phase Butterworth of order 4, analytic signal, Hann, amplitudes of the mean-free envelope.
x = noise(14, 1500) * (1.0 + 0.6 * np.cos(2 * np.pi * 20.0 * np.arange(1500) / 1000.0))
sections = signal.butter(4, [100.0, 300.0], "bandpass", fs=1000.0, output="sos")
filtered = signal.sosfiltfilt(sections, x)
envelope = np.abs(signal.hilbert(filtered))
window = signal.get_window("hann", 1500)
lines = 2.0 * np.abs(np.fft.rfft((envelope - envelope.mean()) * window)) / window.sum()

print(
    json.dumps(
        {
            "uneven": {"rate": rate, "values": spline.tolist()},
            "pulses": {"times": pulses.tolist(), "first": int(np.ceil(pulses[0] * 2000.0)), "angle": angle[::11].tolist()},
            "jerk": np.gradient(record, 1.0 / 500.0).tolist(),
            "envelope": lines[1:-1:5].tolist(),
        }
    )
)
