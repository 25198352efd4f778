"""The examples, with few studies."""

from __future__ import annotations

import subprocess
import sys

import pytest

from conftest import ROOT

FOLDER = ROOT / "python" / "examples"


def run(name: str, *words: str) -> str:
    done = subprocess.run([sys.executable, str(FOLDER / name), *words], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_a_cluster_of_which_a_worker_is_killed() -> None:
    pytest.importorskip("distributed")
    text = run("dask_cluster.py", str(ROOT / "models" / "overhung_rig.toml"), "12")
    assert "killing worker" in text and "12 of 12 results equal" in text


def test_many_studies_in_one_process() -> None:
    text = run("many_studies.py", "20")
    assert "20 studies" in text and "an hour" in text
