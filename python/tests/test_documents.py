"""The Python code of the book and the README runs as it is printed."""

from __future__ import annotations

import re
import shutil
import warnings
from pathlib import Path

import pytest

from conftest import MODELS, ROOT


@pytest.mark.parametrize("document", ["docs/src/python.md", "python/README.md"])
def test_printed_code(document: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shutil.copytree(MODELS, tmp_path / "models")
    shutil.copy(ROOT / "tests" / "data" / "ross" / "rotors" / "example_rotor.toml", tmp_path / "rotor.toml")
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"^```python\n(.*?)^```", (ROOT / document).read_text(encoding="utf-8"), re.S | re.M)
    assert blocks
    names: dict[str, object] = {}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for block in blocks:
            exec(compile(block, document, "exec"), names)
