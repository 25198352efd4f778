"""Modal studies of one rig with a thousand clearances in one process: rate on one core, and memory.

    python many_studies.py [STUDIES [MODEL]]
"""

from __future__ import annotations

import resource
import sys
import time
import warnings
from pathlib import Path

import rotordyn as rd

MODEL = Path(__file__).resolve().parents[2] / "models" / "overhung_rig.toml"


def resident() -> float:
    """Resident memory of this process [MB]."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * resource.getpagesize() / 1e6


def main(count: int, path: Path) -> None:
    rd.set_threads(1)
    warnings.simplefilter("ignore")
    rig = rd.load(path)
    lowest = []
    for k in range(count):
        if k % max(count // 10, 1) == 0:
            print(f"{k:6d} studies: {resident():.1f} MB")
        if k == count // 10:
            start, used = time.perf_counter(), time.process_time()
        rig["bearing.B.radial_clearance"] = f"{5.0 + 20.0 * k / count:.4f} um"
        lowest.append(float(rig.modal(speed="1200 rpm", modes=6).frequency_hz[0]))
    studies = count - count // 10
    wall, cpu = time.perf_counter() - start, time.process_time() - used
    print(f"{count:6d} studies: {resident():.1f} MB, peak {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3:.1f} MB")
    print(f"{1e3 * cpu / studies:.2f} ms of CPU each: {3600.0 * studies / cpu:.0f} an hour of one core ({3600.0 * studies / wall:.0f} by the clock)")
    print(f"first mode {min(lowest):.3f} to {max(lowest):.3f} Hz")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1000, Path(sys.argv[2]) if len(sys.argv) > 2 else MODEL)
