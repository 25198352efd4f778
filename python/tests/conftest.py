"""What the tests share: the models of the repository, and the command of the same wheel."""

from __future__ import annotations

import importlib.util
import json
import subprocess
import sys
import sysconfig
import warnings
from pathlib import Path
from types import ModuleType
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


def as_module(path: Path) -> ModuleType:
    """A program of the repository as a module.

    Its folder is no place to import from: processes that tests start would find the package without its native part there.
    """
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[path.stem] = module
    spec.loader.exec_module(module)
    return module


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
