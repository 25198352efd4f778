"""Reference values for the signal tools, computed by scipy and stored in tests/data/scipy_signal.json.

Run: python3 oracle.py
The inputs come from the formula in `noise`, the same in Rust, so that only results are stored.
"""

import json
from pathlib import Path

import numpy as np
import scipy
from scipy import signal, stats


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
n = 400
t = np.arange(n) / fs
x = noise(1, n) + np.sin(2 * np.pi * 50 * t)
y = 0.5 * np.roll(x, 3) + 0.3 * noise(2, n) + 0.2

windows = {
    "Rectangular": "boxcar",
    "Hann": "hann",
    "Hamming": "hamming",
    "Blackman": "blackman",
    "FlatTop": "flattop",
}
out = {"source": f"scipy {scipy.__version__}, numpy {np.__version__}, oracle.py"}
out["windows"] = [
    {"kind": kind, "n": m, "samples": signal.get_window(name, m, fftbins=True).tolist()}
    for kind, name in windows.items()
    for m in (1, 2, 15, 16)
]

welch = []
for kind, segment, overlap, detrend in [
    ("Hann", 64, 32, "constant"),
    ("Hamming", 75, 50, False),
    ("FlatTop", 64, 0, "constant"),
    ("Rectangular", 400, 0, False),
]:
    args = dict(fs=fs, window=windows[kind], nperseg=segment, noverlap=overlap, detrend=detrend)
    f, pxx = signal.welch(x, **args)
    _, pxy = signal.csd(x, y, **args)
    _, coh = signal.coherence(x, y, **args)
    welch.append(
        {
            "kind": kind,
            "segment": segment,
            "overlap": overlap,
            "remove_mean": detrend == "constant",
            "frequencies": f.tolist(),
            "xx": pxx.tolist(),
            "xy": parts(pxy),
            "coherence": coh.tolist(),
        }
    )
out["welch"] = welch

f, time, s = signal.spectrogram(
    x, fs, window="hann", nperseg=100, noverlap=75, nfft=128, detrend=False, scaling="spectrum", mode="psd"
)
# A one-sided power spectrum: its root is the RMS amplitude.
out["stft"] = {
    "length": 100,
    "hop": 25,
    "fft_length": 128,
    "times": time.tolist(),
    "frequencies": f.tolist(),
    "rms": np.sqrt(s.T)[::4].tolist(),
}

out["hilbert"] = [{"n": m, "analytic": parts(signal.hilbert(x[:m]))} for m in (1, 2, 99, 100)]

butterworth = []
for order, kind, corner in [
    (1, "lowpass", 100.0),
    (4, "lowpass", 50.0),
    (5, "lowpass", 200.0),
    (2, "highpass", 30.0),
    (3, "highpass", 120.0),
    (2, "bandpass", [40.0, 60.0]),
    (3, "bandpass", [20.0, 300.0]),
    (4, "bandpass", [100.0, 200.0]),
    (1, "bandpass", [5.0, 450.0]),
]:
    sos = signal.butter(order, corner, kind, fs=fs, output="sos")
    at = np.array([3.0, 45.0, 110.0, 250.0, 420.0])
    _, h = signal.sosfreqz(sos, at, fs=fs)
    butterworth.append(
        {
            "order": order,
            "kind": kind,
            "corner": corner,
            "at": at.tolist(),
            "response": parts(h),
            "filtered": signal.sosfilt(sos, x)[::7].tolist(),
            "zero_phase": signal.sosfiltfilt(sos, x)[::7].tolist(),
        }
    )
out["butterworth"] = butterworth

out["statistics"] = {
    "skewness": stats.skew(y**3),
    "kurtosis": stats.kurtosis(y**3, fisher=False),
    "standard_deviation": np.std(y**3),
    "rms": np.sqrt(np.mean(y**6)),
}

path = Path(__file__).resolve().parents[1] / "data" / "scipy_signal.json"
path.write_text(json.dumps(out) + "\n")
print(path, path.stat().st_size)
