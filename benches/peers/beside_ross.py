#!/usr/bin/env python3
"""CPU time (user + system) of rotordyn beside ROSS 3.1.0, by turns, for a rotor of 40 elements.

    python3.13 -m venv target/peers && target/peers/bin/python -m pip install ross-rotordynamics==3.1.0
    cargo build --release
    benches/peers/beside_ross.py target/release/rotordyn target/peers/bin/python [--runs 5] [--only TEXT]

Two ratios of medians: of whole processes, with start, import and output; and without what a process takes that only reads the
model (`rotordyn check`, a ROSS that builds the rotor). ROSS runs with one thread, and rotordyn too. The two do different work:

- frf: ROSS forms the response of all 246 degrees of freedom to all, rotordyn the ten pairs of the file;
- critical: ROSS iterates to 0.5 %, rotordyn to round-off; rotordyn finds all to 1000 rad/s, with directions;
- campbell: rotordyn follows branches by their shapes and writes results.h5; ROSS sorts by frequency;
- newmark: 1 s in 10,000 steps at 400 rad/s with unbalance, in 12 modes; rotordyn adds the static corrections of its bearings and loads,
  an energy balance, and a check of the step.
"""

import argparse
import os
import statistics
import subprocess
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
MODEL = str(HERE.parent / "rotor_40.toml")
NEWMARK = {
    "speed.profile": '"constant"',
    "speed.speed": '"400 rad/s"',
    "speed.duration": '"1 s"',
    "study.run_up.integrator": '"newmark"',
    "study.run_up.step": '"100 us"',
    "study.run_up.sample_rate": '"10 kHz"',
    "study.run_up.cutoff": '"400 Hz"',
}
# Case of ours, and what it needs beside the model.
CASES = {
    "modal": [],
    "campbell": [],
    "critical": [],
    "unbalance": [],
    "frf": [],
    "newmark": [word for path, value in NEWMARK.items() for word in ("--set", f"{path}={value}")],
}
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1", "NUMBA_NUM_THREADS": "1"}


def cpu_seconds(command, folder):
    """CPU time of a process; its messages are shown if it fails."""
    environment = {**os.environ, **ONE_THREAD}
    with open(Path(folder) / "messages", "w+") as messages:
        process = subprocess.Popen(command, cwd=folder, env=environment, stdout=messages, stderr=messages)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            messages.seek(0)
            raise SystemExit(f"{' '.join(command)} ends with {process.returncode}:\n{messages.read()}")
    return usage.ru_utime + usage.ru_stime


def ours(program, case):
    if case == "start":
        return [program, "check", MODEL]
    study = "run-up" if case == "newmark" else case
    return [program, study, MODEL, "--no-figures", "-q", "--threads", "1", "--out", "out", *CASES[case]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("python", help="the interpreter that has ROSS")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--only", default="", help="cases whose name contains this text")
    options = parser.parse_args()
    program = os.path.abspath(options.program)
    # Not resolved: an environment is known by the place of its interpreter.
    python = os.path.abspath(options.python)
    start = [0.0, 0.0]
    print("| | rotordyn | ROSS 3.1.0 | whole process | without start |\n|---|---|---|---|---|")
    for case in ["start", *(name for name in CASES if options.only in name)]:
        times = [[], []]
        for _ in range(options.runs):
            for side, command in enumerate([ours(program, case), [python, str(HERE / "ross_case.py"), case]]):
                with tempfile.TemporaryDirectory() as folder:
                    times[side].append(cpu_seconds(command, folder))
        found = [statistics.median(side) for side in times]
        if case == "start":
            start = found
        net = [max(whole - begin, 1e-3) for whole, begin in zip(found, start)]
        ratio = "" if case == "start" else f"{net[1] / net[0]:.0f}"
        print(f"| {case} | {1e3 * found[0]:.0f} ms | {found[1]:.2f} s | {found[1] / found[0]:.0f} | {ratio} |", flush=True)


if __name__ == "__main__":
    main()
