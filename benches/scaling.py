#!/usr/bin/env python3
"""CPU time and peak memory of whole commands over the size of the model, for the speed chapter of the book.

    cargo build --release && python3 benches/scaling.py [BINARY] [--only TEXT]

Each command runs on one thread, without figures. Writes benches/scaling.json; Linux only (ru_maxrss in kB).
"""

import argparse
import json
import os
import statistics
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
RIG = str(ROOT / "models/overhung_rig.toml")
ROTOR = str(ROOT / "benches/rotor_40.toml")
FREE_BALLS = str(ROOT / "models/free_balls.toml")


def with_elements(n):
    return [f"shaft.element_length={1500 / n} mm"]


def large(bearing, balls):
    """A bearing with room for 128 balls of the models."""
    sizes = {"pitch_diameter": "400 mm", "bore": "350 mm", "outside_diameter": "450 mm", "balls": balls}
    return [f"bearing.{bearing}.{key}={value}" for key, value in sizes.items()]


def with_balls(n):
    return ["study.orders.cuts=[1, 2]", *large("A", n), *large("B", n)]


def with_free_balls(n):
    profile = {"settle": "0.01 s", "ramp": "0.03 s", "hold": "0.06 s", "to": "3000 rpm"}
    settings = [f"speed.{key}={value}" for key, value in profile.items()]
    orders = ["study.campbell.orders=[1]", "study.spectrogram.orders=[1]", "study.orders.cuts=[1]", "study.orders.resolution=0.5"]
    return [*settings, "study.spectrogram.length=0.02 s", *orders, *large("A", n)]


# What grows, its sizes, and the commands with the settings for a size.
SERIES = {
    "elements of the shaft": (
        [10, 20, 40, 80, 160, 320, 640, 1250, 2500, 5000],
        {name: (name, ROTOR, with_elements) for name in ["modal", "campbell", "critical", "frf", "unbalance"]},
    ),
    "balls in each bearing": (
        [4, 8, 16, 32, 64, 128],
        {
            "run-up": ("run-up", RIG, with_balls),
            "run-up, free balls": ("run-up", FREE_BALLS, with_free_balls),
            "static": ("static", RIG, with_balls),
            "campbell": ("campbell", RIG, with_balls),
        },
    ),
    "speeds": (
        [10 * 4**k for k in range(5)],
        {
            "campbell": ("campbell", ROTOR, lambda n: [f"study.campbell.speeds={{ from = '0 rad/s', to = '975 rad/s', count = {n} }}"]),
            "unbalance": ("unbalance", ROTOR, lambda n: [f"study.unbalance.speeds={{ from = '1 rad/s', to = '1000 rad/s', count = {n} }}"]),
            "unbalance of the rig": ("unbalance", RIG, lambda n: [f"study.unbalance.speeds={{ from = '20 rpm', to = '4000 rpm', count = {n} }}"]),
        },
    ),
    "seconds of run-up": (
        [5 * 2**k for k in range(8)],
        {"run-up": ("run-up", RIG, lambda n: [f"speed.ramp={n} s", "speed.settle=0.5 s", "speed.hold=0.5 s"])},
    ),
}


def cost(binary, command, model, settings):
    """CPU time [s] and peak memory [MB]."""
    with tempfile.TemporaryDirectory() as folder:
        arguments = [part for setting in settings for part in ("--set", setting)]
        options = ["--out", folder, "--no-figures", "-q", "--threads", "1"]
        process = subprocess.Popen([binary, command, model, *arguments, *options], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        error = process.stderr.read().decode()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            raise SystemExit(f"{command} {settings}: exit code {process.returncode}\n{error}")
        return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", nargs="?", default=str(ROOT / "target/release/rotordyn"))
    parser.add_argument("--only", default="", help="series whose name contains this text; nothing is written then")
    options = parser.parse_args()
    found = []
    for grows, (sizes, commands) in SERIES.items():
        if options.only not in grows:
            continue
        for name, (command, model, settings) in commands.items():
            for size in sizes:
                # Short commands three times, as the machine has other work too.
                runs = [cost(options.binary, command, model, settings(size))]
                runs += [cost(options.binary, command, model, settings(size)) for _ in range(2 if runs[0][0] < 2 else 0)]
                seconds, memory = (statistics.median(column) for column in zip(*runs))
                print(f"{grows:24} {name:22} {size:8} {seconds:9.3f} s {memory:8.1f} MB", flush=True)
                found.append({"grows": grows, "command": name, "size": size, "cpu_s": round(seconds, 4), "memory_mb": round(memory, 1)})
    if not options.only:
        (ROOT / "benches/scaling.json").write_text("[\n" + ",\n".join(" " + json.dumps(row) for row in found) + "\n]\n")


if __name__ == "__main__":
    main()
