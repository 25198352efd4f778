"""Results of the linear studies."""

from __future__ import annotations

import json as _json
import os
from typing import Any, ClassVar, Iterator, Sequence, Union

import numpy as np

from . import _native, tree
from ._quantities import Quantities
from ._values import file_path
from .errors import Error, InputError, RotordynWarning
from .figure import Figure
from .tree import Array, Group, Table, _needed

__all__ = [
    "Campbell",
    "Critical",
    "CriticalMap",
    "Frf",
    "Modal",
    "Result",
    "Static",
    "Torsional",
    "Unbalance",
]


class Result(Quantities):
    """What a study found: its quantities are attributes, see :class:`rotordyn.Group`.

    A result keeps what it needs of the model; the model may change or go afterwards. Results can be pickled.
    """

    _section: ClassVar[str] = ""

    def __init__(self, native: _native.StudyResults) -> None:
        self._native = native
        self._content: Any = None
        self._figures: dict[str, str] | None = None

    @property
    def _group(self) -> Any:
        if self._content is None:
            found = self._native.tree().get(self._section)
            self._content = Group([]) if found is None else self._read(found)
        return self._content

    def _read(self, found: Any) -> Any:
        return tree.of_fields(found)

    def unit(self, name: str) -> str:
        """Unit of a quantity."""
        return str(self._group.unit(name))

    @property
    def study(self) -> str:
        """Name of the study's command."""
        return self._native.study

    @property
    def complete(self) -> bool:
        """Whether the study came to its end; False after Ctrl-C."""
        return self._native.complete

    @property
    def warnings(self) -> list[RotordynWarning]:
        """All warnings, those of the model file first."""
        return [RotordynWarning(*texts) for texts in self._native.warnings[0]]

    def to_dict(self) -> dict[str, Any]:
        """The document that the command prints with ``--json``, without what is of the command (times, files)."""
        found: dict[str, Any] = _json.loads(self._native.json())
        return found

    def to_json(self) -> str:
        """:meth:`to_dict` as text."""
        return self._native.json()

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes a results file (HDF5), as the command's ``results.h5``."""
        self._native.save(file_path("save", path))

    def _drawn(self) -> dict[str, str]:
        if self._figures is None:
            # The first one is the machine, which no study computes.
            self._figures = dict(self._native.figures()[1:])
        return self._figures

    @property
    def figures(self) -> list[str]:
        """Names of the figures."""
        return list(self._drawn())

    def plot(self, name: str | None = None, backend: str = "svg") -> Any:
        """A figure: the first one, or one of ``figures`` by its name.

        ``backend="plotly"`` gives a plotly figure of the curves instead of the SVG; it needs the package plotly.
        """
        if not isinstance(backend, str) or backend not in ("svg", "plotly"):
            raise InputError(f'backend is "svg" or "plotly", not {backend!r}')
        if backend == "plotly":
            from . import _plotly

            return _plotly.figure(self, name)
        drawn = self._drawn()
        if not drawn:
            raise InputError(f"there is no figure of {self.study}")
        wanted = next(iter(drawn)) if name is None else name
        if not isinstance(wanted, str) or wanted not in drawn:
            raise InputError(f"there is no figure {name!r}; there are: {', '.join(drawn)}")
        return Figure(wanted, drawn[wanted])

    def _repr_html_(self) -> str | None:
        drawn = self._drawn()
        return next(iter(drawn.values())) if drawn else None

    def _table(self) -> Any:
        """The table of the result."""
        if isinstance(self._group, Table):
            return self._group
        tables = [self._group[name] for name in self._group.keys()]
        return next((found for found in tables if isinstance(found, Table)), None)

    def to_pandas(self) -> Any:
        """The result's main table as a pandas DataFrame; needs pandas."""
        table = self._table()
        if table is None:
            raise InputError(f"results of {self.study} have no table")
        return table.to_pandas()

    def to_xarray(self) -> Any:
        """The arrays over their axes as an xarray Dataset; needs xarray."""
        return _dataset(self._group)

    def __repr__(self) -> str:
        name, title = self._native.model
        kind = type(self).__name__
        return tree._described(f"{kind} of {title or name}", self._group)

    def __reduce__(self) -> Any:
        text, name, folder, variant, changes = self._native.parts
        state = (text, name, folder, variant, changes)
        _, known = self._native.warnings
        return _restored, (type(self), state, self.study, self._native.bytes(), known, self.complete)


def _restored(kind: type[Result], state: Any, study: str, found: bytes, known: int, complete: bool) -> Result:
    text, name, folder, variant, changes = state
    source = _native.Source.of_text(text, name, os.fspath(folder), variant, changes)
    return kind(_native.results_of_bytes(source, study, found, known, complete))


class Static(Result):
    """Static equilibrium: ``bearings``, ``shaft``, ``nodes``, ``support_forces``; forces [N, N m] act on the shaft."""

    _section = "equilibrium"

    def _table(self) -> Any:
        return self._group["nodes"] if "nodes" in self._group else None


class Modal(Result):
    """Damped modes at one or more speeds, in order of frequency.

    Of one speed the arrays have the mode as first dimension, of several speeds the speed and the mode (NaN where a speed
    has fewer modes); ``modes[k]`` are the modes of speed ``k``.

    ``frequency_hz`` [Hz], ``omega`` [rad/s], ``zeta`` (also ``damping_ratio``), ``log_decrement``, ``eigenvalue`` [1/s]
    (complex), ``shapes`` complex, ``(modes, nodes, 6)``: u_x u_y u_z theta_x theta_y theta_z of every node, phi^H M phi = 1;
    ``whirl`` (modes, shaft nodes): +1 forward circle, -1 backward circle; ``effective_mass`` (modes, 3), ``kind``,
    ``label``. ``speed_rpm``, ``nodes`` (names), ``rigid_body_modes`` (in words).
    """

    _section = "modal"

    def __repr__(self) -> str:
        name, title = self._native.model
        speeds = ", ".join(f"{speed:g}" for speed in self._speeds["speed_rpm"])
        modes = self.modes[0] if self.modes else Group([])
        return f"<Modal of {title or name} at {speeds} rpm>\n" + tree._described("modes", modes)

    @property
    def _speeds(self) -> Table:
        found: Table = self._group
        return found

    def __len__(self) -> int:
        return len(self._speeds)

    def __iter__(self) -> Iterator[Group]:
        return iter(self._speeds)

    def __getitem__(self, name: Any) -> Any:
        if isinstance(name, (int, np.integer)):
            return self._speeds.row(int(name))["modes"]
        return getattr(self, name)

    @property
    def modes(self) -> list[Table]:
        """Table of the modes at every speed."""
        found: list[Table] = self._speeds["modes"]
        return found

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        tables = self.modes
        if tables and name in tables[0]:
            return tables[0][name] if len(tables) == 1 else _stacked([table[name] for table in tables])
        if tables and name not in self._speeds:
            return getattr(tables[0], name)
        column = getattr(self._speeds, name)
        return column[0] if len(tables) == 1 else column

    def keys(self) -> list[str]:
        """Names of the quantities: of the speeds and of the modes."""
        own = [name for name in self._speeds.keys() if name != "modes"]
        return own + (self.modes[0].keys() if self.modes else [])

    def unit(self, name: str) -> str:
        """Unit of a quantity."""
        return self._speeds.unit(name) if name in self._speeds else self.modes[0].unit(name)

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *(dir(self.modes[0]) if self.modes else [])})

    def to_pandas(self) -> Any:
        """The modes of all speeds as a pandas DataFrame, with a column ``speed_rpm``; needs pandas."""
        pandas = _needed("pandas")
        frames = []
        for speed, table in zip(self._speeds["speed_rpm"], self.modes):
            frame = table.to_pandas()
            frame.insert(0, "speed_rpm", speed)
            frames.append(frame)
        return pandas.concat(frames, ignore_index=True)

    def to_xarray(self) -> Any:
        """Frequencies, damping and shapes over speed and mode as an xarray Dataset; needs xarray."""
        xarray = _needed("xarray")
        one = len(self) == 1
        names = ["frequency_hz", "damping_ratio", "log_decrement", "eigenvalue", "shape", "whirl"]
        dims = {"shape": ("node", "dof"), "whirl": ("shaft_node",)}
        found = {}
        for name in names:
            values = np.asarray(getattr(self, name))
            values = values[np.newaxis] if one else values
            found[name] = (("speed_rpm", "mode", *dims.get(name, ())), values, {"units": self.unit(name)})
        nodes = list(self._speeds["nodes"][0])
        coords = {"speed_rpm": self._speeds["speed_rpm"], "node": nodes, "dof": _DOFS}
        return xarray.Dataset(found, coords=coords)


_DOFS = ["u_x", "u_y", "u_z", "theta_x", "theta_y", "theta_z"]


class Campbell(Result):
    """Campbell diagram.

    ``speeds_rpm`` [rpm]; ``branches``: a table with a row for each mode followed over the speeds: ``frequency_hz`` [Hz],
    ``zeta``, ``log_decrement``, ``eigenvalue`` [1/s] of shape (branches, speeds), NaN where a branch was not followed,
    ``label``, ``kind``; ``crossings``: critical speeds, a table with ``speed_rpm``, ``order``, ``frequency_hz``;
    ``thresholds``: speeds at which a mode becomes unstable; ``least_damped``.
    """

    _section = "campbell"

    @property
    def frequency_hz(self) -> Array:
        """Frequencies [Hz], shape (branches, speeds)."""
        found: Array = self._group["branches"]["frequency_hz"]
        return found

    @property
    def log_decrement(self) -> Array:
        """Logarithmic decrements, shape (branches, speeds)."""
        found: Array = self._group["branches"]["log_decrement"]
        return found

    def to_pandas(self) -> Any:
        """Frequencies [Hz] as a pandas DataFrame: a row for each speed, a column for each branch; needs pandas."""
        pandas = _needed("pandas")
        index = pandas.Index(self._group["speeds_rpm"], name="speed_rpm")
        return pandas.DataFrame(self.frequency_hz.T, index=index, columns=list(self._group["branches"]["label"]))

    def to_xarray(self) -> Any:
        """Frequency, damping and eigenvalue over branch and speed as an xarray Dataset; needs xarray."""
        xarray = _needed("xarray")
        branches = self._group["branches"]
        names = ["frequency_hz", "zeta", "log_decrement", "eigenvalue"]
        found = {name: (("branch", "speed_rpm"), branches[name], {"units": branches.unit(name)}) for name in names}
        coords = {"speed_rpm": self._group["speeds_rpm"], "label": ("branch", list(branches["label"]))}
        return xarray.Dataset(found, coords=coords)


class Critical(Result):
    """Critical speeds: ``speeds``, a table with ``speed_rpm``, ``order``, ``frequency_hz``, ``damping_ratio``, ``label``,
    ``shape``; ``max_speed_rpm``, ``nodes``, ``uncertain``."""

    _section = "critical_speeds"

    @property
    def speed_rpm(self) -> Array:
        """Critical speeds [rpm], lowest first."""
        found: Array = self._group["speeds"]["speed_rpm"]
        return found


class CriticalMap(Result):
    """Critical speed map: ``stiffness_n_per_m``, ``curves``, ``bearings``, ``crossings``."""

    _section = "critical_map"


class Torsional(Result):
    """Torsional modes and their interference diagram: ``modes``, ``interferences``, ``z_m``."""

    _section = "torsional"


class Frf(Result):
    """Frequency response functions.

    ``frequency_hz`` [Hz] (requested ones and those added at resonances; ``requested``: indices of the former);
    ``response`` complex, shape (responses, excitations, frequencies); names ``responses``, ``excitations``; ``units``.
    ``frf["disc x", "disc x"]`` is the function of a response and an excitation.
    """

    _section = "frf"

    def __getitem__(self, name: Any) -> Any:
        if not isinstance(name, tuple):
            return super().__getitem__(name)
        if len(name) != 2:
            raise InputError('a function is frf[response, excitation], such as frf["disc x", "disc y"]')
        at = []
        for wanted, kind in zip(name, ("responses", "excitations")):
            known = list(self._group[kind])
            if not isinstance(wanted, str) or wanted not in known:
                raise InputError(tree._unknown(wanted, known))
            at.append(known.index(wanted))
        return self._group["response"][at[0], at[1]]

    def to_xarray(self) -> Any:
        """The functions over response, excitation and frequency as an xarray Dataset; needs xarray."""
        xarray = _needed("xarray")
        coords = {
            "response": list(self._group["responses"]),
            "excitation": list(self._group["excitations"]),
            "frequency_hz": self._group["frequency_hz"],
        }
        name = str(self._group["quantity"])
        found = {name: (("response", "excitation", "frequency_hz"), self._group["response"])}
        return xarray.Dataset(found, coords=coords)

    def to_pandas(self) -> Any:
        """The functions as a pandas DataFrame: a row for each frequency, a column for each pair; needs pandas."""
        pandas = _needed("pandas")
        index = pandas.Index(self._group["frequency_hz"], name="frequency_hz")
        columns = {
            (response, excitation): self[response, excitation]
            for response in self._group["responses"]
            for excitation in self._group["excitations"]
        }
        return pandas.DataFrame(columns, index=index)


class Unbalance(Result):
    """Unbalance response: ``speeds_rpm`` [rpm]; ``responses``: a table of amplitudes X (``re``, ``im``) over the speeds,
    x(t) = Re(X exp(j Omega t)); ``orbits``, ``peaks``, ``bearing_forces``, ``separation_margins``.
    ``unbalance["disc_y"]`` are the complex amplitudes X of a response over the speeds.
    """

    _section = "unbalance"

    def __getitem__(self, name: Any) -> Any:
        known = [str(found) for found in self._group["responses"]["name"]]
        if not isinstance(name, str) or name not in known:
            return super().__getitem__(name)
        row = self._group["responses"][known.index(name)]
        return row["re"] + 1j * row["im"]


def _stacked(values: Sequence[Any]) -> Any:
    """Arrays of several speeds in one, filled up with NaN (texts with None)."""
    rows = max((len(value) for value in values), default=0)
    first = np.asarray(values[0])
    kind = first.dtype if first.dtype.kind in "fcO" else np.dtype(float)
    out = np.full((len(values), rows, *first.shape[1:]), None if kind == object else np.nan, dtype=kind)
    for k, value in enumerate(values):
        out[k, : len(value)] = value
    return out


def _dataset(group: Any) -> Any:
    """Arrays of a group over the axes that they name."""
    xarray = _needed("xarray")
    if not isinstance(group, Group):
        raise Error("these results have no arrays over axes")
    found, coords = {}, {}
    for name in group.keys():
        quantity = group._found[name]
        value = quantity.value
        if not isinstance(value, np.ndarray) or value.ndim == 0:
            continue
        dims = [f"{name}_{k}" for k in range(value.ndim)]
        for k, axis in quantity.axes:
            points = group._found.get(axis)
            if points is not None and isinstance(points.value, np.ndarray) and len(points.value) == value.shape[k]:
                dims[k] = axis
                coords[axis] = points.value
        found[name] = (tuple(dims), value, {"units": quantity.unit})
    used = [id(value) for value in coords.values()]
    data = {name: entry for name, entry in found.items() if name not in coords and id(entry[1]) not in used}
    return xarray.Dataset(data, coords=coords)
