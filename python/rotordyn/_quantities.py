"""Quantities of a result as its attributes."""

from __future__ import annotations

from typing import Any


class Quantities:
    """Gives the members of ``_group``, a :class:`rotordyn.Group`, as attributes and items."""

    @property
    def _group(self) -> Any:
        raise NotImplementedError

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self._group, name)

    def __getitem__(self, name: Any) -> Any:
        return self._group[name]

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *dir(self._group)})

    def keys(self) -> list[str]:
        """Names of the quantities."""
        return list(self._group.keys())
