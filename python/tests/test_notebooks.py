"""The notebooks are those of their programs, without outputs, and run; long parts only by `notebooks/make.py --run`."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from conftest import ROOT, as_module

FOLDER = ROOT / "python" / "notebooks"
make = as_module(FOLDER / "make.py")

PROGRAMS = make.programs()


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda path: str(path.stem))
def test_notebook(program: Path) -> None:
    written = program.with_suffix(".ipynb").read_text(encoding="utf-8")
    assert make.notebook(program) == written, "run python/notebooks/make.py after a change"
    found = json.loads(written)
    assert all(cell["outputs"] == [] for cell in found["cells"] if cell["cell_type"] == "code")
    assert found["cells"][0]["cell_type"] == "markdown"


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda path: str(path.stem))
def test_program_runs(program: Path) -> None:
    environment = {key: value for key, value in os.environ.items() if key != "ROTORDYN_LONG"}
    done = subprocess.run([sys.executable, program.name], cwd=FOLDER, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
