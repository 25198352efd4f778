"""Results of run-ups, and of their spectrograms and orders."""

from __future__ import annotations

from typing import Any, Iterator, Sequence

import numpy as np
import numpy.typing as npt

from . import _native, tree
from ._values import flags
from .errors import InputError
from .results import Result, _dataset
from .tree import Group, _needed

__all__ = ["Orders", "RunUp", "Spectrograms"]


class RunUp(Result):
    """A run-up: ``run["B_ax"]`` are the samples of a channel, over ``time`` [s], ``speed_rpm`` and ``angle`` [rad].

    ``channels`` names them with their units. ``complete`` is False if the run was stopped by Ctrl-C; it then holds what
    was computed until then.
    """

    _section = "run_up"

    @property
    def time(self) -> npt.NDArray[np.float64]:
        """Times of the samples [s]."""
        return self._samples("time")

    @property
    def speed_rpm(self) -> npt.NDArray[np.float64]:
        """Speed at every sample [rpm]."""
        return self._samples("speed") * (60.0 / (2.0 * np.pi))

    @property
    def angle(self) -> npt.NDArray[np.float64]:
        """Angle of the shaft at every sample [rad]."""
        return self._samples("angle")

    @property
    def channels(self) -> dict[str, str]:
        """Names of the channels and their units."""
        return {name: unit for name, unit, *_ in self._native.channels()}

    def _samples(self, name: str) -> npt.NDArray[np.float64]:
        found = self._native.samples(name)
        if found is None:
            raise InputError(f"there is no channel {name!r}; {tree._unknown(name, list(self.channels))}")
        return found

    def __getitem__(self, name: Any) -> Any:
        if not isinstance(name, str):
            raise InputError(f"a channel is named by a text, not {name!r}")
        return self._samples(name)

    def spectrogram(
        self,
        *channels: str,
        window: str | None = None,
        length: str | None = None,
        overlap: float | None = None,
        max_frequency: str | None = None,
        orders: Sequence[Any] | None = None,
    ) -> Spectrograms:
        """Spectrograms (STFT) of channels; without any, of those that the model file names.

        ``window``: hann, flattop ...; ``length``: of the window, such as "0.5 s"; ``overlap``: 0 to 1.
        """
        given = {"window": window, "length": length, "overlap": overlap, "max_frequency": max_frequency}
        return Spectrograms(_native.run_spectrograms(self._native, _analysis(channels, {**given, "orders": orders})))

    def orders(
        self,
        *channels: str,
        orders: Sequence[Any] | None = None,
        resolution: float | None = None,
        max_order: float | None = None,
        bandwidth: float | None = None,
    ) -> Orders:
        """Order tracking of channels; ``orders``: those of the cuts, such as [1, 2, "BPFO"]."""
        given = {"orders": orders, "resolution": resolution, "max_order": max_order, "bandwidth": bandwidth}
        return Orders(_native.run_orders(self._native, _analysis(channels, given)))

    def to_pandas(self) -> Any:
        """The samples as a pandas DataFrame over the time [s]; needs pandas."""
        pandas = _needed("pandas")
        columns = {"speed_rpm": self.speed_rpm, **{name: self[name] for name in self.channels}}
        return pandas.DataFrame(columns, index=pandas.Index(self.time, name="time"))

    def to_xarray(self) -> Any:
        """The samples as an xarray Dataset over the time [s]; needs xarray."""
        xarray = _needed("xarray")
        found = {name: (("time",), self[name], {"units": unit}) for name, unit in self.channels.items()}
        return xarray.Dataset(found, coords={"time": self.time, "speed_rpm": ("time", self.speed_rpm)})


def _analysis(channels: Sequence[Any], given: dict[str, Any]) -> list[str]:
    return flags({"channels": list(channels) or None, **given})


class _PerChannel(Result):
    """Results for one channel after another: ``result[k]`` or ``result["B_ax"]``."""

    def _read(self, found: Any) -> Any:
        return [tree.of_fields(fields) for fields in found]

    def __len__(self) -> int:
        return len(self._all)

    @property
    def _all(self) -> list[Group]:
        return self._group if isinstance(self._group, list) else []

    def __iter__(self) -> Iterator[Group]:
        return iter(self._all)

    def __getitem__(self, name: Any) -> Group:
        if isinstance(name, (int, np.integer)):
            return self._all[int(name)]
        known = [str(group["channel"]) for group in self._all]
        if not isinstance(name, str) or name not in known:
            raise InputError(tree._unknown(name, known))
        return self._all[known.index(name)]

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        if len(self._all) != 1:
            raise AttributeError(f"there are {len(self._all)} channels: take result[k].{name}")
        return getattr(self._all[0], name)

    def __dir__(self) -> list[str]:
        return sorted({*object.__dir__(self), *(dir(self._all[0]) if self._all else [])})

    def keys(self) -> list[str]:
        """Names of the quantities of a channel."""
        return self._all[0].keys() if self._all else []

    def unit(self, name: str) -> str:
        """Unit of a quantity."""
        return self._all[0].unit(name)

    def to_pandas(self) -> Any:
        """The only channel's table; take ``result[k]`` of several."""
        raise InputError(f"results of {self.study} have no table; take the arrays of result[k]")

    def to_xarray(self) -> Any:
        """The arrays of the only channel, or of each in a dictionary, as xarray Datasets; needs xarray."""
        found = {str(group["channel"]): _dataset(group) for group in self._all}
        return next(iter(found.values())) if len(found) == 1 else found

    def __repr__(self) -> str:
        return "\n".join(tree._described(f"{type(self).__name__} {group['channel']}", group) for group in self._all)


class Spectrograms(_PerChannel):
    """Spectrograms: ``amplitude`` (times, frequencies) over ``time`` [s], ``frequency`` [Hz], with the speed."""

    _section = "spectrograms"


class Orders(_PerChannel):
    """Order tracking: ``cuts``, levels of the orders over the speed; the order map."""

    _section = "orders"
