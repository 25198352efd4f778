"""What the tests share: the models of the repository, and the command of the same wheel."""

from __future__ import annotations

import json
import subprocess
import sysconfig
import warnings
from pathlib import Path
from typing import Any

import pytest

import rotordyn as rd

ROOT = Path(__file__).resolve().parents[2]
MODELS = ROOT / "models"
COMMAND = Path(sysconfig.get_path("scripts")) / "rotordyn"


def load(name: str) -> rd.Model:
    """A model of the repository, without its warnings."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return rd.load(MODELS / name)


def command(*words: str) -> dict[str, Any]:
    """The document of a command."""
    done = subprocess.run([COMMAND, *words, "--json", "--quiet"], capture_output=True, text=True, check=False)
    assert done.stdout, done.stderr
    found: dict[str, Any] = json.loads(done.stdout)
    return found


@pytest.fixture
def jeffcott() -> rd.Model:
    return load("jeffcott.toml")


@pytest.fixture
def rig() -> rd.Model:
    return load("overhung_rig.toml")
