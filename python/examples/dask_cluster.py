"""Modes of a rig over the clearance of its bearing, on a Dask cluster of two workers, of which one is killed on the way.

    pip install "rotordyn[plotly]" "dask[distributed]"
    python dask_cluster.py [MODEL [STUDIES]]

What the killed worker had is computed anew by the other one, and by the one that is started in its place; the results are
those of one process, bit for bit.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
import warnings
from pathlib import Path

import rotordyn as rd

MODEL = Path(__file__).resolve().parents[2] / "models" / "overhung_rig.toml"


def kill_one(client: object, scheduler: object, done: int) -> None:
    """Kills a worker when some of its tasks are done."""
    deadline = time.monotonic() + 60.0
    while time.monotonic() < deadline:
        tasks = getattr(scheduler, "tasks", {})
        if sum(1 for task in list(tasks.values()) if task.state == "memory") >= done:
            break
        time.sleep(0.02)
    pids = list(client.run(os.getpid).values())  # type: ignore[attr-defined]
    print(f"killing worker {pids[0]} of {pids}")
    os.kill(pids[0], signal.SIGKILL)


def main(path: Path, count: int) -> int:
    from dask.distributed import Client, LocalCluster

    # Each worker has one core: one study computes with one thread.
    os.environ["RAYON_NUM_THREADS"] = "1"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        rig = rd.load(path)
        changes = [{"bearing.B.radial_clearance": f"{5.0 + 20.0 * k / count:.4f} um"} for k in range(count)]
        with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
            killer = threading.Thread(target=kill_one, args=(client, cluster.scheduler, count // 4))
            killer.start()
            found = rd.map(changes, "modal", base=rig, executor=client, speed="1200 rpm", modes=4)
            killer.join()
        alone = rd.map(changes, "modal", base=rig, speed="1200 rpm", modes=4)
    same = [a.to_json() == b.to_json() for a, b in zip(found, alone)]
    print(f"{sum(same)} of {count} results equal those of one process")
    lowest = [float(modes.frequency_hz[0]) for modes in found]
    print(f"first mode: {min(lowest):.3f} to {max(lowest):.3f} Hz")
    return 0 if all(same) and len(same) == count else 1


if __name__ == "__main__":
    model = Path(sys.argv[1]) if len(sys.argv) > 1 else MODEL
    raise SystemExit(main(model, int(sys.argv[2]) if len(sys.argv) > 2 else 40))
