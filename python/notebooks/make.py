#!/usr/bin/env python3
"""Writes a notebook without outputs for each program of this folder, or runs the programs.

    python make.py          writes NAME.ipynb from NAME.py
    python make.py --run    runs every NAME.py, the long ones too, and tells the time of each

A program has cells: `# %%` begins code, `# %% [markdown]` text in comments.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).resolve().parent


def programs() -> list[Path]:
    """The programs of the notebooks."""
    return sorted(path for path in FOLDER.glob("*.py") if path.name != "make.py")


def cells(text: str) -> list[tuple[str, str]]:
    """Kind and content of every cell."""
    out = []
    for part in re.split(r"^# %%", text, flags=re.M)[1:]:
        mark, _, content = part.partition("\n")
        if mark.strip() == "[markdown]":
            lines = [line[2:] if line.startswith("# ") else line.lstrip("#") for line in content.strip().splitlines()]
            out.append(("markdown", "\n".join(lines)))
        else:
            out.append(("code", content.strip()))
    return out


def notebook(path: Path) -> str:
    """The notebook of a program, without outputs."""

    def cell(number: int, kind: str, content: str) -> dict[str, Any]:
        lines = content.splitlines(keepends=True)
        own: dict[str, Any] = {"cell_type": kind, "id": f"cell-{number}", "metadata": {}, "source": lines}
        if kind == "code":
            own |= {"execution_count": None, "outputs": []}
        return own

    found = {
        "cells": [cell(k, kind, content) for k, (kind, content) in enumerate(cells(path.read_text(encoding="utf-8")))],
        "metadata": {
            "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
            "language_info": {"name": "python"},
        },
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return json.dumps(found, indent=1, ensure_ascii=False) + "\n"


def main() -> int:
    if sys.argv[1:] == ["--run"]:
        failed = []
        for path in programs():
            start = time.perf_counter()
            done = subprocess.run([sys.executable, path.name], cwd=FOLDER, env={**os.environ, "ROTORDYN_LONG": "1"}, check=False)
            print(f"{path.name}: {time.perf_counter() - start:.1f} s{'' if done.returncode == 0 else ', FAILED'}", flush=True)
            failed += [path.name] * (done.returncode != 0)
        return 1 if failed else 0
    for path in programs():
        path.with_suffix(".ipynb").write_text(notebook(path), encoding="utf-8")
        print(f"{path.stem}.ipynb written")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
