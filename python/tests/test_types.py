"""Types: mypy in strict mode on the package and on a program that uses it."""

import subprocess
import sys
from pathlib import Path

import pytest

import rotordyn

TESTS = Path(__file__).parent


def test_strict_types(tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    package = Path(rotordyn.__file__).parent
    words = ["-m", "mypy", "--strict", "--cache-dir", str(tmp_path), str(package), str(TESTS / "typed.py")]
    done = subprocess.run([sys.executable, *words], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
