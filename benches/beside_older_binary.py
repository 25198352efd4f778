#!/usr/bin/env python3
"""CPU time (user + system) of whole commands beside that of an older binary, which takes its own models.

    git worktree add /tmp/older COMMIT && (cd /tmp/older && cargo build --release)
    cargo build --release
    benches/beside_older_binary.py /tmp/older/target/release/rotordyn target/release/rotordyn \\
        --older-models /tmp/older/models [--runs 5] [--only TEXT]

Both run by turns, so that a machine whose speed drifts drifts for both; the ratio of the medians counts.
"""

import argparse
import os
import statistics
import subprocess
import tempfile
from pathlib import Path

MODELS = Path(__file__).resolve().parent.parent / "models"
RIG = "overhung_rig.toml"
ROTOR = str(Path(__file__).resolve().parent / "rotor_40.toml")
RUN_UP = ["--no-figures", "-q", "--threads", "1"]
COMMANDS = {
    "run-up": ["run-up", RIG, *RUN_UP],
    "run-up, wavy": ["run-up", RIG, "--variant", "wavy", *RUN_UP],
    "run-up, dented": ["run-up", RIG, "--variant", "dented", *RUN_UP],
    "run": ["run", RIG, "-q"],
    "run, no figures": ["run", RIG, "-q", "--no-figures"],
    "campbell": ["campbell", RIG, "--no-figures", "-q"],
    "critical": ["critical", RIG, "--no-figures", "-q"],
    "unbalance": ["unbalance", RIG, "--no-figures", "-q"],
    "campbell, 40 elements": ["campbell", ROTOR, "--no-figures", "-q"],
    "critical, 40 elements": ["critical", ROTOR, "--no-figures", "-q"],
    "unbalance, 40 elements": ["unbalance", ROTOR, "--no-figures", "-q"],
    "frf, 40 elements": ["frf", ROTOR, "--no-figures", "-q"],
    "modal": ["modal", RIG, "--no-figures", "-q"],
    "modal with figures": ["modal", RIG, "-q"],
}


def cpu_seconds(binary, models, arguments):
    """CPU time of one command in an empty folder; None where it fails, as an older binary without the command does."""
    with tempfile.TemporaryDirectory() as folder:
        arguments = [str(models / RIG) if argument == RIG else argument for argument in arguments]
        command = [os.path.abspath(binary), *arguments, "--out", folder]
        process = subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        return usage.ru_utime + usage.ru_stime if process.returncode == 0 else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("older")
    parser.add_argument("newer")
    parser.add_argument("--older-models", type=Path, default=MODELS, help="models of the older binary")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--only", default="", help="commands whose name contains this text")
    options = parser.parse_args()
    print(f"{'command':22} {'older s':>9} {'newer s':>9} {'older/newer':>12}   spread of either")
    for name, arguments in COMMANDS.items():
        if options.only not in name:
            continue
        sides = [(options.older, options.older_models.resolve(), []), (options.newer, MODELS, [])]
        for _ in range(options.runs):
            for binary, models, found in sides:
                found.append(cpu_seconds(binary, models, arguments))
        times = [found for _, _, found in sides]
        if any(None in found for found in times):
            print(f"{name:22} fails")
            continue
        older, newer = (statistics.median(found) for found in times)
        spread = ", ".join(f"{min(found):.3f} to {max(found):.3f}" for found in times)
        print(f"{name:22} {older:9.3f} {newer:9.3f} {older / newer:12.2f}   {spread}")


if __name__ == "__main__":
    main()
