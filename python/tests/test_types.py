"""Types: mypy in strict mode on the package and on a program that uses it."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import rotordyn

TESTS = Path(__file__).parent


def test_strict_types(tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    # Beside the packages that it uses mypy takes them for its own.
    shutil.copytree(Path(rotordyn.__file__).parent, tmp_path / "rotordyn")
    shutil.copy(TESTS / "typed.py", tmp_path)
    words = ["-m", "mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), "rotordyn", "typed.py"]
    done = subprocess.run([sys.executable, *words], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
