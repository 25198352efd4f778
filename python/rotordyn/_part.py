"""Parts of a model made in code, written as tables of the model file."""

from __future__ import annotations

from typing import Any, Iterable, Mapping, Sequence, TypeVar

from ._values import key_of, toml, words
from .errors import InputError

__all__ = ["Part"]

Same = TypeVar("Same", bound="Part")


class Part:
    """A table of the model file. ``values`` are its keys as given, ``to_toml()`` its text.

    Quantities are texts with their unit, as in the file. The reader of the file checks them when a model is made of the
    parts, see :meth:`rotordyn.Model.build`.
    """

    #: Table of the file, such as ``disc``.
    _table = ""
    #: Keys that are the same for every part of the class, as they stand in the file.
    _fixed: dict[str, Any] = {}
    #: Keys with lists of parts.
    _lists: tuple[str, ...] = ()

    def __init__(self, name: str | None, given: Mapping[str, Any]) -> None:
        if name is not None and not (isinstance(name, str) and name):
            raise InputError(f'the name of a part is a text such as "main", not {name!r}')
        self.name = name
        own = {key: value for key, value in given.items() if value is not None}
        self.values: dict[str, Any] = {**self._fixed, **own}

    @property
    def _path(self) -> str:
        return self._table if self.name is None else f"{self._table}.{key_of(self.name)}"

    def to_toml(self) -> str:
        """The table as it stands in the file."""
        lists = [key for key in self._lists if isinstance(self.values.get(key), (list, tuple))]
        lines = [f"[{self._path}]"] if self.values.keys() - set(lists) or not lists else []
        lines += [f"{key_of(key)} = {_value(value)}" for key, value in self.values.items() if key not in lists]
        for key in lists:
            for item in self.values[key]:
                values = item.values if isinstance(item, Part) else item
                if not isinstance(values, Mapping):
                    raise InputError(f"{self._path}.{key} is a list of parts or dictionaries, not of {item!r}")
                lines += ["", f"[[{self._path}.{key_of(key)}]]"]
                lines += [f"{key_of(inner)} = {_value(value)}" for inner, value in values.items()]
        return "\n".join(lines).strip() + "\n"

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and isinstance(other, Part) and self.to_toml() == other.to_toml()

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        given = [repr(self.name)] if self.name is not None else []
        given += [f"{key}={value!r}" for key, value in self.values.items() if key not in self._fixed]
        return f"{type(self).__name__}({', '.join(given)})"


def _value(value: Any) -> str:
    if isinstance(value, Part):
        return toml(value.values)
    if isinstance(value, (list, tuple)) and any(isinstance(item, Part) for item in value):
        return toml([item.values if isinstance(item, Part) else item for item in value])
    return toml(value)


def _tables(at: str, values: Mapping[str, Any]) -> Iterable[str]:
    """Tables of nested dictionaries: plain values first."""
    plain = {key: value for key, value in values.items() if not isinstance(value, Mapping)}
    yield "\n".join([f"[{at}]", *(f"{key_of(key)} = {_value(value)}" for key, value in plain.items())]) + "\n"
    for key, value in values.items():
        if isinstance(value, Mapping):
            yield from _tables(f"{at}.{key_of(key)}", value)


def written(
    name: str,
    parts: Sequence[Part],
    *,
    stations: Mapping[str, str] | None = None,
    title: str | None = None,
    gravity: str | None = None,
    study: Mapping[str, Any] | None = None,
) -> str:
    """The text of a model file of parts."""
    for what, given in (("stations", stations), ("study", study)):
        if given is not None and not isinstance(given, Mapping):
            raise InputError(f"{what} are a dictionary, not {given!r}")
    head = {"name": words(name), "title": title, "gravity": gravity}
    out = ["\n".join(["[model]", *(f"{key} = {toml(value)}" for key, value in head.items() if value is not None)]) + "\n"]
    seen: set[str] = set()
    for part in parts:
        if not isinstance(part, Part) or not part._table:
            raise InputError(f"parts of a model are such as rd.Shaft or rd.Disc, not {part!r}")
        if "." in part._table:
            raise InputError(f"{type(part).__name__} stands in a list of rd.Shaft, not by itself: {part!r}")
        if part._path in seen:
            raise InputError(f"{part._path} is given twice; names of parts are unique in their kind")
        seen.add(part._path)
        out.append(part.to_toml())
    if stations:
        out.append("\n".join(["[station]", *(f"{key_of(key)} = {toml(value)}" for key, value in stations.items())]) + "\n")
    for key, value in (study or {}).items():
        if not isinstance(value, Mapping):
            raise InputError(f"study.{key} is a dictionary of settings, not {value!r}")
        out.extend(_tables(f"study.{key_of(key)}", value))
    return "\n".join(out)


