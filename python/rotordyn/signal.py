"""Analyses of measured records."""

from __future__ import annotations

import json as _json
from typing import Any, Mapping, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _native, tree
from ._quantities import Quantities
from ._values import array, flags, words
from .errors import InputError, RotordynWarning, _warn
from .figure import Figure
from .tree import Group

__all__ = ["Diagnosis", "diagnose"]


class Diagnosis(Quantities):
    """Analyses of a record: ``statistics``, ``spectrum``, ``envelope``, ... as attributes, see :class:`rotordyn.Group`."""

    def __init__(self, content: Group, document: str, drawn: Sequence[tuple[str, str]], warnings: Sequence[Any]) -> None:
        self._content, self._document, self._drawn = content, document, dict(drawn)
        self.warnings = [RotordynWarning(*texts) for texts in warnings]

    @property
    def _group(self) -> Group:
        return self._content

    @property
    def figures(self) -> list[str]:
        """Names of the figures."""
        return list(self._drawn)

    def plot(self, name: str | None = None) -> Figure:
        """A figure: that of the envelope if there is one, or one of ``figures`` by its name."""
        first = next((known for known in self._drawn if "envelope" in known), None)
        wanted = name if name is not None else first or next(iter(self._drawn), "")
        if not isinstance(wanted, str) or wanted not in self._drawn:
            raise InputError(f"there is no figure {wanted!r}; there are: {', '.join(self._drawn)}")
        return Figure(wanted, self._drawn[wanted])

    def to_dict(self) -> dict[str, Any]:
        """The channel's part of the document that ``rotordyn signal --json`` prints."""
        found: dict[str, Any] = _json.loads(self._document)
        return found

    def __repr__(self) -> str:
        return tree._described("Diagnosis", self._content)


def diagnose(
    x: npt.ArrayLike,
    fs: Union[float, str],
    bearing: str | Mapping[str, float] | None = None,
    speed: str | None = None,
    unit: str = "",
    name: str = "record",
    **settings: Any,
) -> Diagnosis:
    """Analyses a record: statistics, spectra, envelope with the defect frequencies of a bearing.

    ``x``: samples, shape (n,), in ``unit``; ``fs``: sampling rate [Hz], or a text such as "12 kHz"; ``bearing``: a
    designation of the catalogue, or orders ``{"BPFO": 3.58, "BPFI": 5.42}``; ``speed``: of the shaft, such as "1797 rpm".
    ``settings`` are flags of the command ``rotordyn signal``, such as ``band="2 kHz .. 4 kHz"`` or ``harmonics=5``.
    """
    samples = _record(x)
    given: dict[str, Any] = {"speed": speed, **settings}
    if isinstance(bearing, Mapping):
        given["bearing_orders"] = [f"{key}={words(value)}" for key, value in bearing.items()]
    elif bearing is not None:
        given["bearing"] = bearing
    fields, document, drawn, warnings = _native.diagnose(samples, _rate(fs), words(unit), words(name), flags(given))
    _warn(warnings, 2)
    return Diagnosis(tree.of_fields(fields), document, drawn, warnings)


def _record(x: npt.ArrayLike) -> npt.NDArray[np.float64]:
    samples = array("the record", x)
    if samples.ndim != 1:
        raise InputError(f"a record has one dimension, this array has the shape {samples.shape}: take one channel")
    if samples.size == 0:
        raise InputError("the record is empty")
    bad = np.flatnonzero(~np.isfinite(samples))
    if bad.size:
        raise InputError(f"{bad.size} samples are not finite, the first is sample {bad[0]}: cut them out or replace them")
    return samples


def _rate(fs: Union[float, str]) -> float:
    if isinstance(fs, str):
        number, _, unit = fs.strip().partition(" ")
        factors = {"Hz": 1.0, "kHz": 1e3, "MHz": 1e6}
        try:
            rate = float(number) * factors[unit.strip()]
        except (KeyError, ValueError):
            raise InputError(f'fs: {fs!r} is not a sampling rate; such as "12 kHz" or 12000.0') from None
    elif isinstance(fs, (int, float, np.number)) and not isinstance(fs, bool):
        rate = float(fs)
    else:
        raise InputError(f'fs: {fs!r} is not a sampling rate; such as 12000.0 or "12 kHz"')
    if not (np.isfinite(rate) and rate > 0.0):
        raise InputError(f"fs: the sampling rate is {rate} Hz; it must be positive")
    return rate
