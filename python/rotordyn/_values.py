"""Python values as text of the model file, which its reader validates."""

from __future__ import annotations

import math
import os
from typing import Any, Mapping

import numpy as np
import numpy.typing as npt

from .errors import FileError, InputError

__all__: list[str] = []


def toml(value: Any) -> str:
    """A value in TOML: text, number, truth value, list, dictionary, NumPy scalar or array."""
    if hasattr(value, "tolist") and hasattr(value, "dtype"):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return _quoted(value)
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        if math.isnan(value):
            return "nan"
        return repr(value)
    if isinstance(value, Mapping):
        pairs = (f"{key_of(key)} = {toml(inner)}" for key, inner in value.items())
        return "{ " + ", ".join(pairs) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml(item) for item in value) + "]"
    raise InputError(
        f"a value of a model is a text with its unit, a number, True or False, a list or a dictionary, not {value!r} "
        f"({type(value).__name__})"
    )


def words(value: Any) -> str:
    """A value as a flag of the command takes it: texts of a list are separated by commas."""
    if hasattr(value, "tolist") and hasattr(value, "dtype"):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return ",".join(words(item) for item in value)
    if isinstance(value, bool) or not isinstance(value, (str, int, float)):
        raise InputError(f'expected a text with its unit, such as "1200 rpm", or a number, not {value!r}')
    text = value if isinstance(value, str) else repr(value)
    return _checked(text)


#: Flags without a value.
SWITCHES = ("fixed_cage_angle", "cage_average", "skidding", "smooth_tacho")
#: Flags of the command that say where its results go, or which model it reads.
OF_COMMAND = ("csv", "json", "no_figures", "out", "quiet", "read_limit", "set", "strict", "threads", "variant", "write")


def flags(given: Mapping[str, Any]) -> list[str]:
    """Arguments that are not None as flags: ``max_speed="6000 rpm"`` is ``--max-speed=6000 rpm``."""
    out = []
    for name, value in given.items():
        flag = "--" + name.replace("_", "-")
        if name in OF_COMMAND:
            raise InputError(f"{name} belongs to the command; here results are returned, and their save() writes them")
        if value is None:
            continue
        if name not in SWITCHES:
            out.append(f"{flag}={words(value)}")
        elif not isinstance(value, bool):
            raise InputError(f"{name} is True or False, not {value!r}")
        elif value:
            out.append(flag)
    return out


def path(text: Any) -> str:
    """A path of a value, such as ``bearing.B.radial_clearance``."""
    if not isinstance(text, str):
        raise InputError(f'the path of a value is a text such as "bearing.B.radial_clearance", not {text!r}')
    if "=" in text or "\n" in text:
        raise InputError(f'{text!r} is not the path of a value; such as "bearing.B.radial_clearance"')
    return _checked(text)


def key_of(key: Any) -> str:
    """A key of a table, quoted if need be."""
    if not isinstance(key, str) or not key:
        raise InputError(f"names and keys of a model are texts, not {key!r}")
    plain = key.isascii() and all(char.isalnum() or char in "_-" for char in key)
    return key if plain else _quoted(key)


def _quoted(text: str) -> str:
    out = []
    for char in _checked(text):
        if char in '"\\':
            out.append("\\" + char)
        elif ord(char) < 0x20 or ord(char) == 0x7F:
            out.append(f"\\u{ord(char):04x}")
        else:
            out.append(char)
    return '"' + "".join(out) + '"'


def _checked(text: str) -> str:
    """The text, if it is Unicode that can be written as UTF-8."""
    try:
        text.encode()
    except UnicodeEncodeError:
        raise InputError(f"{text!r} is not valid Unicode text") from None
    return text


def file_path(what: str, given: Any) -> str:
    """The path of a file or folder."""
    if not isinstance(given, (str, os.PathLike)):
        raise InputError(f"{what}: the path of a file, not {given!r}")
    found = os.fspath(given)
    if not isinstance(found, str):
        raise InputError(f"{what}: the path of a file as text, not {found!r}")
    try:
        os.fsencode(found)
    except UnicodeEncodeError:
        raise InputError(f"{what}: {found!r} is no path of a file") from None
    if "\0" in found:
        raise InputError(f"{what}: {found!r} is no path of a file: it has a character of value zero")
    return found


def array(what: str, given: Any, kind: Any = np.float64) -> npt.NDArray[Any]:
    """Numbers as an array without gaps; complex ones are refused where real ones are needed."""
    try:
        plain = np.asarray(given)
        if kind is np.float64 and np.iscomplexobj(plain):
            raise InputError(f"{what} is complex; give real numbers")
        return np.ascontiguousarray(plain, dtype=kind)
    except (TypeError, ValueError, OverflowError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"{what} is not an array of numbers: {error}") from None


def write(path: str, content: bytes) -> None:
    """Writes a file."""
    try:
        with open(path, "wb") as out:
            out.write(content)
    except OSError as error:
        raise FileError(f"cannot write {path}: {error.strerror or error}") from None
