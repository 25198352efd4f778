#!/usr/bin/env python3
"""Writes rotordyn/parts.py: a class for each table of the model file, with the keys that its reader declares.

    python python/make_parts.py [COMMAND]      COMMAND: the program rotordyn, else that of the PATH

Run it after a change of the keys of the model file; a test compares.
"""

from __future__ import annotations

import json
import keyword
import subprocess
import sys
import textwrap
from pathlib import Path
from typing import Any

#: Class, table, its condition if the table has several forms, whether it has a name, key of the condition.
CLASSES: list[tuple[str, str, str, bool]] = [
    ("Material", "material", "", True),
    ("Lubricant", "lubricant", "", True),
    ("Section", "shaft.section", "", False),
    ("Layer", "shaft.layer", "", False),
    ("Shaft", "shaft", "", False),
    ("RigidRotor", "rotor", "", False),
    ("Disc", "disc", "", True),
    ("Body", "body", "", True),
    ("Housing", "housing", "", True),
    ("Sensor", "sensor", "", True),
    ("Bushing", "bushing", "", True),
    ("Joint", "joint", "", True),
    ("Belt", "belt", "", True),
    ("BallBearing", "bearing", "ball", True),
    ("RadialBallBearing", "bearing", "radial_ball", True),
    ("FreeBallBearing", "bearing", "free_ball", True),
    ("LinearBearing", "bearing", "linear", True),
    ("ShaftUnbalance", "unbalance", "", True),
    ("Load", "load", "", True),
    ("Probe", "probe", "", True),
    ("Damping", "damping", "", False),
    ("Drive", "drive", "", False),
    ("SpeedProfile", "speed", "", False),
]

#: Tables that a model has beside those of the classes: arguments of Model.build, and what only files have.
OTHERS = {"model", "station", "study", "variant", "$schema"}

PARTS_OF_SHAFT = {"section": "Section", "layer": "Layer"}

TYPES = {
    "count": "int",
    "flag": "bool",
    "text": "str",
    "texts": "str | Sequence[str]",
    "stiffness of a power law": "str",
    "special": "Any",
    "table": "Mapping[str, Any]",
    "list of tables": "Sequence[Mapping[str, Any]]",
    "named tables": "Mapping[str, Any]",
    "named quantities": "Mapping[str, str]",
    "spaced quantities": "str | Sequence[Any] | Mapping[str, Any]",
}


def help_of(command: str, path: str) -> dict[str, Any]:
    """What the program says of a table."""
    words = [command, "help", *([path] if path else []), "--json", "--quiet"]
    found: dict[str, Any] = json.loads(subprocess.run(words, capture_output=True, check=True).stdout)
    return found


def type_of(key: dict[str, Any], table: str) -> str:
    kind = key["kind"]
    if table == "shaft" and key["name"] in PARTS_OF_SHAFT:
        return f"Sequence[{PARTS_OF_SHAFT[key['name']]} | Mapping[str, Any]]"
    if kind == "word":
        return f"Literal[{', '.join(json.dumps(word) for word in key['words'])}]"
    number = not key["unit"]
    if kind == "quantity":
        return "float" if number else "str"
    if kind == "quantities":
        return "float | Sequence[float] | str" if number else "str | Sequence[str]"
    return TYPES[kind]


def argument(key: str) -> str:
    """A key as an argument: `from` is a word of Python."""
    return key + "_" if keyword.iskeyword(key) else key


def forms(members: list[dict[str, Any]], condition: str) -> dict[str, list[dict[str, Any]]]:
    """Keys by name, each with its forms, of a table with a condition."""
    out: dict[str, list[dict[str, Any]]] = {}
    for key in members:
        if condition and key["name"] == "model":
            continue
        wanted = f'model = "{condition}"'
        if condition and not any(not of or wanted in of.split(", ") for of in key["conditions"]):
            continue
        out.setdefault(key["name"], []).append(key)
    return out


def said(name: str, keys: list[dict[str, Any]], condition: str) -> str:
    """What the docstring says of a key."""
    value = " or ".join(dict.fromkeys(key["value"] + (f", {key['range']}" if key["range"] else "") for key in keys))
    own = keys[0]
    without = f" Without it: {own['absent']}." if own["absent"] and own["absent"] != "required" else ""
    needed = " Required." if all(key["required"] for key in keys) else ""
    rests = set()
    for of in own["conditions"]:
        parts = [part for part in of.split(", ") if part and part != f'model = "{condition}"']
        rests.add(", ".join(parts))
    applies = "" if "" in rests or not rests else f" With {' or '.join(sorted(rests))}."
    meaning = " ".join(dict.fromkeys(key["meaning"] for key in keys))
    text = f"``{argument(name)}`` ({value}): {meaning}{needed}{without}{applies}"
    return textwrap.fill(text.replace("\\", "\\\\"), 110, initial_indent="    ", subsequent_indent="        ",
                         break_long_words=False, break_on_hyphens=False)


def class_text(command: str, name: str, table: str, condition: str, named: bool) -> str:
    found = help_of(command, table)
    keys = forms(found["members"], condition)
    meaning = found["keys"][0]["meaning"]
    of = f"[{table}.NAME]" if named else (f"[[{table}]]" if "." in table else f"[{table}]")
    fixed = f' with ``model = "{condition}"``' if condition else ""
    lines = [f"class {name}(Part):"]
    doc = textwrap.fill(f'"""{meaning} ``{of}`` of the model file{fixed}.', 116, initial_indent="    ",
                        subsequent_indent="    ", break_long_words=False, break_on_hyphens=False)
    lines += [doc, ""]
    lines += [said(key, of_key, condition) for key, of_key in keys.items()]
    lines += ['    """', "", f'    _table = "{table}"']
    if condition:
        lines.append(f'    _fixed = {{"model": "{condition}"}}')
    lists = [key for key, of_key in keys.items() if table == "shaft" and key in PARTS_OF_SHAFT]
    if lists:
        lines.append(f"    _lists = ({', '.join(json.dumps(key) for key in lists)},)")
    lines += ["", "    def __init__(", "        self,"]
    if named:
        lines.append("        name: str,")
    lines.append("        *,")
    for key, of_key in keys.items():
        types = " | ".join(dict.fromkeys(part for form in of_key for part in [type_of(form, table)]))
        lines.append(f"        {argument(key)}: {types} | None = None,")
    lines.append("    ) -> None:")
    given = [f'"{key}": {argument(key)}' for key in keys]
    lines.append(f"        super().__init__({'name' if named else 'None'}, {{")
    lines += [f"            {pair}," for pair in given]
    lines.append("        })")
    return "\n".join(lines) + "\n"


def module_text(command: str) -> str:
    covered = {table.split(".")[0] for _, table, _, _ in CLASSES} | OTHERS
    missing = [key["name"] for key in help_of(command, "")["members"] if key["name"] not in covered]
    if missing:
        raise SystemExit(f"tables without a class: {', '.join(missing)}")
    names = sorted(["Part", *(name for name, *_ in CLASSES)])
    head = [
        '"""Parts of a model, a class for each table of the model file. Written by make_parts.py; not to be edited."""',
        "",
        "from __future__ import annotations",
        "",
        "from typing import Any, Literal, Mapping, Sequence",
        "",
        "from ._part import Part",
        "",
        "__all__ = [",
        *(f'    "{name}",' for name in names),
        "]",
        "",
    ]
    return "\n".join(head) + "\n\n" + "\n\n".join(class_text(command, *one) for one in CLASSES)


if __name__ == "__main__":
    command = sys.argv[1] if len(sys.argv) > 1 else "rotordyn"
    target = Path(__file__).parent / "rotordyn" / "parts.py"
    target.write_text(module_text(command), encoding="utf-8")
    print(f"{target} written")
