#!/usr/bin/env python3
"""Collects the times that `cargo bench` left in target/criterion in benches/times.json, for the speed chapter of the book.

    cargo bench && python3 benches/times.py
"""

import datetime
import json
import os
import platform
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CRITERION = ROOT / "target" / "criterion"


def processor():
    for line in Path("/proc/cpuinfo").read_text().splitlines() if Path("/proc/cpuinfo").exists() else []:
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.processor() or platform.machine()


def rows():
    for estimates in sorted(CRITERION.glob("**/new/estimates.json")):
        mean = json.loads(estimates.read_text())["mean"]
        interval = mean["confidence_interval"]
        yield {
            "name": estimates.parent.parent.relative_to(CRITERION).as_posix(),
            "mean_s": float(f"{1e-9 * mean['point_estimate']:.3g}"),
            "half_s": float(f"{0.5e-9 * (interval['upper_bound'] - interval['lower_bound']):.2g}"),
        }


def main():
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True)
    found = {
        "date": datetime.date.today().isoformat(),
        "commit": commit.stdout.strip(),
        "machine": f"{os.cpu_count()} cores of {processor()}",
        "times": list(rows()),
    }
    if not found["times"]:
        raise SystemExit(f"no times in {CRITERION}: run `cargo bench`")
    (ROOT / "benches" / "times.json").write_text(json.dumps(found, indent=1) + "\n")
    print(f"benches/times.json: {len(found['times'])} times")


if __name__ == "__main__":
    main()
