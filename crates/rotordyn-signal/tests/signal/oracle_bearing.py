"""Reference values for the tools that find bearing faults, stored in tests/data/scipy_bearing_signal.json.

Run: python3 oracle_bearing.py
Each method is written out by its definition with numpy and scipy; inputs come from `noise`, the same in Rust.
"""

import json
from pathlib import Path

import numpy as np
import scipy
from scipy import fft, signal, stats


def noise(seed, n):
    """Uniform numbers in -1..1 by a 32-bit linear congruential generator, exact in doubles."""
    out, state = [], seed
    for _ in range(n):
        state = (1664525 * state + 1013904223) % 2**32
        out.append(state / 2**31 - 1)
    return np.array(out)


def parts(z):
    return {"re": z.real.tolist(), "im": z.imag.tolist()}


fs = 1000.0
n = 2500
t = np.arange(n) / fs
x = noise(5, n) * (1 + 0.8 * np.cos(2 * np.pi * 7.3 * t)) + 3 * (np.arange(n) % 97 == 0) + 0.1
out = {"source": f"scipy {scipy.__version__}, numpy {np.__version__}, oracle_bearing.py"}


# Fast kurtogram, Antoni 2007: filters modulated to the band's centre, decimated, odd bands frequency-reversed.
def bank(z, h, count):
    k = np.arange(len(h))
    for i in range(count):
        turned = h * np.exp(1j * np.pi * (2 * i + 1) / (2 * count) * k)
        band = signal.lfilter(turned, 1, z)[count - 1 :: count]
        yield band * (-1.0) ** np.arange(len(band)) if i % 2 else band


def envelope_kurtosis(z):
    power = abs(z - z.mean()) ** 2
    return np.mean(power**2) / np.mean(power) ** 2 - 2


halves, thirds = signal.firwin(17, 0.4), signal.firwin(25, 2 / 3 * 0.4)
nodes = [(x - x.mean()).astype(complex)]
kurtogram = [[stats.kurtosis(x)]]
depth = 4
for level in range(1, depth + 1):
    ternary = [band for z in nodes for band in bank(z, thirds, 3)]
    nodes = [band for z in nodes for band in bank(z, halves, 2)]
    kurtogram.append([envelope_kurtosis(z[16:]) for z in nodes])
    if level < depth:
        kurtogram.append([envelope_kurtosis(z[24:]) for z in ternary])
out["kurtogram"] = {"depth": depth, "levels": kurtogram}

_, _, s = signal.spectrogram(x, fs, "hann", 100, 75, detrend=False, mode="complex")
power = abs(s) ** 2
sk = np.mean(power**2, axis=1) / np.mean(power, axis=1) ** 2 - 2
sk[[0, -1]] -= 1
out["spectral_kurtosis"] = {"segment": 100, "overlap": 75, "values": sk.tolist()}

cepstra = []
for m in (399, 400):
    spectrum = fft.fft(x[:m])
    cepstrum = fft.ifft(np.log(abs(spectrum))).real
    power_cepstrum = abs(fft.ifft(np.log(abs(spectrum) ** 2))) ** 2
    quefrency = np.minimum(np.arange(m), m - np.arange(m)) / fs
    tooth = 0.01
    lifters = {
        "low": quefrency <= 0.0205,
        "high": (quefrency > 0.0205) | (quefrency == 0),
        "comb": (abs(quefrency - tooth * np.round(quefrency / tooth)) > 0.0015) | (np.round(quefrency / tooth) == 0),
    }
    edited = {}
    for name, kept in lifters.items():
        log = fft.fft(cepstrum * kept).real
        edited[name] = {
            "magnitude": np.exp(log)[: m // 2 + 1].tolist(),
            "record": fft.ifft(np.exp(log + 1j * np.angle(spectrum))).real.tolist(),
        }
    cepstra.append(
        {
            "n": m,
            "real": cepstrum[: m // 2 + 1].tolist(),
            "power": power_cepstrum[: m // 2 + 1].tolist(),
            "limit": 0.0205,
            "tooth": tooth,
            "half_width": 0.0015,
            "lifted": edited,
        }
    )
out["cepstra"] = cepstra

bands = []
for m, low, high in [(400, 100.0, 200.0), (399, 50.0, 437.0), (400, 0.0, 500.0), (401, 333.0, 500.0)]:
    spectrum = fft.fft(x[:m])
    f = np.arange(m) * fs / m
    keep = (f >= low) & (f < high) if high < fs / 2 else (f >= low) & (f <= fs / 2)
    scale = np.where((f == 0) | (f == fs / 2), 1, 2) * keep * (f <= fs / 2)
    z = fft.ifft(scale * spectrum)
    squared = abs(z) ** 2
    window = signal.get_window("hann", m)
    amplitude = 2 * abs(fft.rfft((squared - squared.mean()) * window)) / window.sum()
    bands.append({"n": m, "low": low, "high": high, "analytic": parts(z), "squared_envelope": amplitude[1:-1].tolist()})
out["bands"] = bands

# Cyclic spectral coherence, Antoni 2007, averaged cyclic periodogram with the segments' own times.
segment, hop = 64, 16
window = signal.get_window("hann", segment)
coherence = []
for alpha in (0.0, 7.3, 14.6, 31.7, 250.0):
    upper = (x - x.mean()) * np.exp(-1j * np.pi * alpha * t)
    lower = (x - x.mean()) * np.exp(1j * np.pi * alpha * t)
    xx = yy = xy = 0
    for start in range(0, n - segment + 1, hop):
        u = fft.fft(window * upper[start : start + segment])[: segment // 2 + 1]
        v = fft.fft(window * lower[start : start + segment])[: segment // 2 + 1]
        xx, yy, xy = xx + abs(v) ** 2, yy + abs(u) ** 2, xy + u * v.conj()
    coherence.append({"alpha": alpha, "squared": (abs(xy) ** 2 / (xx * yy)).tolist()})
out["cyclic"] = {"segment": segment, "overlap": segment - hop, "rows": coherence}

absolute = abs(x)
out["statistics"] = {
    "mean_absolute": absolute.mean(),
    "shape_factor": np.sqrt(np.mean(x**2)) / absolute.mean(),
    "impulse_factor": absolute.max() / absolute.mean(),
    "clearance_factor": absolute.max() / np.mean(np.sqrt(absolute)) ** 2,
}

path = Path(__file__).resolve().parents[1] / "data" / "scipy_bearing_signal.json"
path.write_text(json.dumps(out) + "\n")
print(path, path.stat().st_size)
