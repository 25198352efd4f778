#!/usr/bin/env python3
"""Resident memory of a long run-up of the rig over time: benches/run_up_memory.py BINARY [SECONDS [STEP_US]]

Ten channels at 4 kHz, with spectrograms, order tracking and all figures. Prints the memory over the run and its peak; it
should stay within 10 % from the first simulated minute to the end of the run, and below 300 MB until the program ends.
Linux only (/proc).
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time

PROBES = [("A_vx", "housing.A", "x"), ("A_vy", "housing.A", "y"), ("B_vx", "housing.B", "x")]


def model(folder):
    rig = pathlib.Path(__file__).parent.parent / "models/overhung_rig.toml"
    more = "".join(
        f'[probe.{name}]\nat = "{at}"\ndirection = "{way}"\nquantity = "velocity"\n\n' for name, at, way in PROBES
    )
    text = rig.read_text()
    place = text.index("[probe.A_ax]")
    path = folder / "rig.toml"
    path.write_text(text[:place] + more + text[place:])
    return path


def resident(pid):
    """Resident memory now and at most [MB]; None after the end."""
    try:
        text = pathlib.Path(f"/proc/{pid}/status").read_text()
    except OSError:
        return None
    found = dict(re.findall(r"^(VmRSS|VmHWM):\s*(\d+)", text, re.M))
    return [int(found[key]) / 1e3 for key in ("VmRSS", "VmHWM")] if len(found) == 2 else None


def main():
    binary, seconds, step = sys.argv[1:] + ["600", "50"][len(sys.argv) - 2 :]
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        settings = [
            f"speed.ramp={float(seconds) - 10} s",
            "speed.hold=9 s",
            f"study.run_up.step={step} us",
        ]
        command = [binary, "run", str(model(folder)), "--json", "--out", str(folder / "out")]
        command += [part for setting in settings for part in ("--set", setting)]
        output = folder / "output.json"
        with output.open("w") as to:
            run = subprocess.Popen(command, stdout=to, stderr=subprocess.DEVNULL)
        start, samples, peak = time.time(), [], 0.0
        while run.poll() is None:
            now = resident(run.pid)
            if now:
                size = sum(path.stat().st_size for path in folder.glob("out/*.h5"))
                samples.append((time.time() - start, now[0], size))
                peak = max(peak, now[1])
            time.sleep(0.25)
        end = json.loads(output.read_text())
        print(f"exit {run.returncode}; {end['run_up']['samples']} samples, {len(end['run_up']['channels'])} columns")
        for k in range(0, len(samples), max(1, len(samples) // 60)):
            print("%8.1f s  %7.1f MB resident  results %7.1f MB" % (samples[k][0], samples[k][1], samples[k][2] / 1e6))
        print(f"peak {peak:.1f} MB")


main()
