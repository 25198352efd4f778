"""A machine of a model file, and its studies."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING, Any, Callable, Iterator, Mapping, Sequence, TextIO, TypeVar, Union

import numpy as np
import numpy.typing as npt

from . import _native
from ._values import file_path, flags, path, toml, words, write
from .analysis import BearingAnalysis
from .errors import InputError, _warn
from .results import (
    Campbell,
    Critical,
    CriticalMap,
    Frf,
    Modal,
    Result,
    Static,
    Torsional,
    Unbalance,
)
from .runs import RunUp

if TYPE_CHECKING:
    from ._part import Part

__all__ = ["Bearing", "Matrices", "Model", "load"]

#: A text with its unit, such as "1200 rpm".
Quantity = str
Progress = Union[bool, Callable[[float, float, float], object]]
Matrix = npt.NDArray[np.float64]
Found = TypeVar("Found", bound=Result)


def load(path: Union[str, "os.PathLike[str]"], variant: str | None = None) -> Model:
    """Reads a model file (TOML), with one of its variants.

    Raises :class:`rotordyn.InputError` with all problems of the file at once, :class:`rotordyn.FileError` if it cannot be
    read. Gives a :class:`rotordyn.RotordynWarning` for each warning of the file.
    """
    return Model(_native.Source.read(file_path("load", path), _variant(variant)), _stacklevel=3)


class Model:
    """A machine as its model file describes it, with a variant and changed values.

    Made by :func:`rotordyn.load` or :meth:`Model.from_toml`. Values are read and changed by their path in the file::

        rig["bearing.B.radial_clearance"] = "20 um"

    A change is validated at once; a value that is refused leaves the model as it was. Studies take the model as it is when
    they begin: another thread may change it meanwhile. Models can be pickled and copied.
    """

    def __init__(self, native: _native.Source, *, _stacklevel: int = 2) -> None:
        self._native = native
        self._known: set[tuple[str, ...]] = set()
        self._tell(_stacklevel + 1)

    @classmethod
    def from_toml(
        cls,
        text: str,
        name: str = "model",
        folder: Union[str, "os.PathLike[str]"] = "",
        variant: str | None = None,
    ) -> Model:
        """The model of a text; ``name`` stands in messages, ``folder`` has the files to which the text refers."""
        if not isinstance(text, str):
            raise InputError(f"the model is a text (TOML), not {type(text).__name__}")
        try:
            data = text.encode()
        except UnicodeEncodeError as error:
            raise InputError(f"the model is not valid Unicode text: {error}") from None
        return cls(_native.Source.of_text(data, words(name), file_path("folder", folder), _variant(variant), []), _stacklevel=3)

    @classmethod
    def build(
        cls,
        name: str,
        *parts: Part,
        stations: Mapping[str, str] | None = None,
        title: str | None = None,
        gravity: str | None = None,
        study: Mapping[str, Any] | None = None,
        folder: Union[str, "os.PathLike[str]"] = "",
    ) -> Model:
        """The model of parts made in code, such as :class:`rotordyn.Shaft` and :class:`rotordyn.Disc`.

        ``stations``: places on the shaft by name, ``{"A": "0 mm"}``; ``study``: settings of studies,
        ``{"modal": {"modes": 6}}``. The parts are written as a model file, which its reader validates: messages show the
        lines of :meth:`to_toml`.
        """
        from ._part import written

        text = written(name, parts, stations=stations, title=title, gravity=gravity, study=study)
        return cls(_native.Source.of_text(text.encode(), f"model {name}", file_path("folder", folder), None, []), _stacklevel=3)

    def _with_text(self, text: str) -> Model:
        """The same changes and variant of another text."""
        _, name, folder, variant, changes = self._native.parts
        other = object.__new__(Model)
        other._native = _native.Source.of_text(text.encode(), name, folder, variant, changes)
        other._known = set(self._known)
        return other

    def _tell(self, stacklevel: int) -> None:
        """Gives the warnings of the file that were not given yet."""
        new = [texts for texts in self._native.warnings if texts not in self._known]
        self._known.update(new)
        _warn(new, stacklevel)

    @property
    def name(self) -> str:
        """Name of the model."""
        return self._native.name

    @property
    def title(self) -> str:
        """Title of the model; its name if it has none."""
        return self._native.title

    @property
    def variants(self) -> list[str]:
        """Names of the variants of the file."""
        return self._native.variants

    @property
    def changes(self) -> dict[str, str]:
        """Changed values by path, in TOML."""
        return dict(self._native.parts[4])

    def variant(self, name: str) -> Model:
        """The model with another variant of its file and the same changes; "base" is the file without variant."""
        if not isinstance(name, str):
            raise InputError(f"the name of a variant is a text, not {name!r}")
        return Model(self._native.with_variant(words(name)), _stacklevel=3)

    def copy(self) -> Model:
        """A model whose changes do not concern this one."""
        other = object.__new__(Model)
        other._native, other._known = self._native, set(self._known)
        return other

    __copy__ = copy

    def __deepcopy__(self, memo: object) -> Model:
        return self.copy()

    def __getitem__(self, key: str) -> Any:
        """A value as it is written in the file (a text with its unit, a number, a list, a dictionary).

        Of a key that the file does not give, the text of the default that the model takes.
        """
        found = self._native.value(path(key))
        # Defaults are texts of the file, quoted if they are texts there.
        quoted = isinstance(found, str) and len(found) > 1 and found[0] == found[-1] == '"'
        return found[1:-1] if quoted else found

    def __setitem__(self, key: str, value: Any) -> None:
        self._change({key: value}, 3)

    def change(self, values: Mapping[str, Any]) -> None:
        """Changes several values at once, for those that are valid only together."""
        if not isinstance(values, Mapping):
            raise InputError(f"changes are a dictionary of paths and values, not {values!r}")
        self._change(values, 3)

    def _change(self, values: Mapping[str, Any], stacklevel: int) -> None:
        changes = dict(self._native.parts[4])
        for key, value in values.items():
            # The last change stands last.
            changes.pop(path(key), None)
            changes[path(key)] = toml(value)
        self._native = self._native.with_changes(list(changes.items()))
        self._tell(stacklevel + 1)

    def with_changes(self, values: Mapping[str, Any]) -> Model:
        """A copy with changed values."""
        other = self.copy()
        other._change(values, 3)
        return other

    def to_dict(self) -> dict[str, Any]:
        """All values as they are written in the file, with variant and changes."""
        return self._native.values()

    def to_toml(self) -> str:
        """The text of the model: of the file as it is, or with variant or changes of the model as it stands."""
        return self._native.to_toml()

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes :meth:`to_toml` to a file."""
        write(file_path("save", path), self.to_toml().encode())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Model) and self._native.parts == other._native.parts

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        changes = "".join(f", {key} = {value}" for key, value in self.changes.items())
        variant = self._native.parts[3]
        of = f", variant {variant}" if variant else ""
        return f"<Model {self.name}: {self.title}{of}{changes}>"

    def __reduce__(self) -> Any:
        text, name, folder, variant, changes = self._native.parts
        return _restored, ((text, name, os.fspath(folder), variant, changes), self._known)

    # Studies

    def static(self, speed: Quantity | None = None, fixed_cage_angle: bool = False, **keys: Any) -> Static:
        """Static equilibrium at a speed, such as "1200 rpm"; by default that of the file, else standstill.

        ``fixed_cage_angle``: at the cage angles of the model instead of the average over them. ``keys`` are other keys of
        ``[study.static]``, as in ``rotordyn help study.static``.
        """
        return self._study(Static, "static", {"speed": speed, "fixed_cage_angle": fixed_cage_angle}, keys)

    def modal(self, speed: Quantity | Sequence[Quantity] | None = None, modes: int | None = None, **keys: Any) -> Modal:
        """Damped modes at a speed, such as "1200 rpm", or at several; ``modes``: their number.

        By default at the speeds of ``[study.modal]``, else at standstill and the top speed of the file. ``keys`` are other
        keys of that section.
        """
        if speed is not None and not isinstance(speed, str) and hasattr(speed, "__len__"):
            return self._study(Modal, "modal", {"modes": modes}, {"speeds": speed, **keys})
        return self._study(Modal, "modal", {"speed": speed, "modes": modes}, keys)

    def campbell(self, max_speed: Quantity | None = None, modes: int | None = None, **keys: Any) -> Campbell:
        """Campbell diagram up to a speed, such as "6000 rpm", at 25 speeds; ``modes``: their number.

        ``keys`` are other keys of ``[study.campbell]``, such as ``speeds`` or ``orders``.
        """
        return self._study(Campbell, "campbell", {"max_speed": max_speed, "modes": modes}, keys)

    def critical(self, max_speed: Quantity | None = None, orders: Sequence[Any] | None = None, **keys: Any) -> Critical:
        """Critical speeds up to a speed; ``orders`` such as ``[1, 2, "BPFO"]``."""
        return self._study(Critical, "critical", {"max_speed": max_speed, "orders": orders}, keys)

    def critical_map(
        self,
        max_speed: Quantity | None = None,
        lowest_stiffness: Quantity | None = None,
        highest_stiffness: Quantity | None = None,
        **keys: Any,
    ) -> CriticalMap:
        """Undamped critical speeds over the stiffness of all bearings."""
        given = {"max_speed": max_speed, "lowest_stiffness": lowest_stiffness, "highest_stiffness": highest_stiffness}
        return self._study(CriticalMap, "critical-map", given, keys)

    def torsional(
        self,
        max_speed: Quantity | None = None,
        orders: Sequence[Any] | None = None,
        modes: int | None = None,
        speed_range: Quantity | None = None,
        **keys: Any,
    ) -> Torsional:
        """Torsional modes and the speeds at which orders meet them."""
        given = {"max_speed": max_speed, "orders": orders, "modes": modes, "speed_range": speed_range}
        return self._study(Torsional, "torsional", given, keys)

    def frf(
        self,
        speed: Quantity | None = None,
        max_frequency: Quantity | None = None,
        quantity: str | None = None,
        **keys: Any,
    ) -> Frf:
        """Frequency response functions at a speed; ``quantity``: receptance, mobility or accelerance.

        ``keys`` are other keys of ``[study.frf]``, such as ``excitation``, ``response``, ``frequencies``.
        """
        given = {"speed": speed, "max_frequency": max_frequency, "quantity": quantity}
        return self._study(Frf, "frf", given, keys)

    def unbalance(self, max_speed: Quantity | None = None, speed_range: Quantity | None = None, **keys: Any) -> Unbalance:
        """Response to the unbalances of the file over the speed; ``speed_range``: operating speeds "900, 1200 rpm"."""
        return self._study(Unbalance, "unbalance", {"max_speed": max_speed, "speed_range": speed_range}, keys)

    def _study(self, kind: type[Found], command: str, given: dict[str, Any], keys: Mapping[str, Any]) -> Found:
        found = kind(_native.linear_study(self._native, [command, *flags(given)], _keys(command, keys)))
        _warn_of(found, 3)
        return found

    def run_up(
        self,
        step: Quantity | None = None,
        integrator: str | None = None,
        sample_rate: Quantity | None = None,
        progress: Progress = False,
        **keys: Any,
    ) -> RunUp:
        """Nonlinear run-up through the speed profile of the file, its samples in memory.

        ``progress=True`` shows it, or a function of time [s], duration [s] and speed [rpm] is called about twenty times a
        second. Ctrl-C ends the run with what was computed until then, and a warning ``incomplete-run``. ``keys`` are
        other keys of ``[study.run_up]``.
        """
        given = {"step": step, "integrator": integrator, "sample_rate": sample_rate}
        shown = _Bar(sys.stderr) if progress is True else None
        call = shown if shown is not None else (progress if callable(progress) else None)
        try:
            found = RunUp(_native.run_up(self._native, ["run-up", *flags(given)], _keys("run-up", keys), call))
        finally:
            if shown is not None:
                shown.close()
        _warn_of(found, 2)
        return found

    def matrices(self, speed: Quantity = "0 rpm") -> Matrices:
        """M, C, G, K of M q'' + (C + Omega G) q' + K q = f, linearised about the equilibrium at a speed."""
        omega, found, dofs = _native.matrices(self._native, words(speed))
        return Matrices(*found, speed_rpm=omega * 30.0 / np.pi, dofs=dofs)

    @property
    def dofs(self) -> list[str]:
        """Names of the degrees of freedom of :meth:`matrices`: node and direction."""
        return self.matrices().dofs

    def to_ross(self, speeds: Sequence[Quantity] = ("0 rpm",)) -> Any:
        """The linear part of the machine as a ``ross.Rotor``; needs the package ross-rotordynamics.

        Bearings have their coefficients at ``speeds``: contacts are linearised at their equilibrium at each. Nodes of ROSS
        are those of the shaft, then one for each body. Each part that ROSS cannot have is a warning ``not-imported``: tilt
        stiffness of bearings, rotations of housings, modal damping, unbalances and loads, which belong to its runs.
        """
        from ._ross import to_ross

        return to_ross(self, speeds)

    def bearing(self, name: str) -> Bearing:
        """A bearing of the model."""
        known = self._native.bearings
        if not isinstance(name, str) or name not in known:
            from .tree import _unknown

            raise InputError(_unknown(name, known))
        return Bearing(self, name)


def _restored(parts: Any, known: set[tuple[str, ...]]) -> Model:
    model = object.__new__(Model)
    text, name, folder, variant, changes = parts
    model._native, model._known = _native.Source.of_text(text, name, folder, variant, changes), set(known)
    return model


def _keys(command: str, keys: Mapping[str, Any]) -> list[tuple[str, str]]:
    section = command.replace("-", "_")
    return [(path(f"study.{section}.{key}"), toml(value)) for key, value in keys.items() if value is not None]


def _variant(name: str | None) -> str | None:
    if name is not None and not isinstance(name, str):
        raise InputError(f"the name of a variant is a text, not {name!r}")
    return None if name is None or name == "base" else words(name)


def _warn_of(found: Result, stacklevel: int) -> None:
    """Gives the warnings of a study; those of the file were given with the model."""
    all_texts, known = found._native.warnings
    _warn(all_texts[known:], stacklevel + 1)


class Matrices:
    """Matrices of M q'' + (C + Omega G) q' + K q = f; ``M, C, G, K = rig.matrices(...)``.

    ``M`` [kg, kg m, kg m^2], ``C`` [N s/m, ...] of bearings and damping, ``G`` [kg m^2] gyroscopic, skew-symmetric, ``K``
    [N/m, N, N m/rad], each (n, n); ``dofs``: names of q, node and direction; ``speed_rpm``.
    """

    def __init__(self, M: Matrix, C: Matrix, G: Matrix, K: Matrix, *, speed_rpm: float, dofs: list[str]) -> None:
        self.M, self.C, self.G, self.K = M, C, G, K
        self.speed_rpm, self.dofs = speed_rpm, dofs

    def __iter__(self) -> Iterator[Matrix]:
        return iter((self.M, self.C, self.G, self.K))

    def __repr__(self) -> str:
        return f"<Matrices of {len(self.dofs)} degrees of freedom at {self.speed_rpm:g} rpm: M, C, G, K, dofs>"


class Bearing:
    """A bearing of a model, with the equilibrium of the machine at a speed."""

    def __init__(self, model: Model, name: str) -> None:
        self.model, self.name = model, name

    def _at(self, speed: Quantity | None) -> Any:
        found = self.model.static(speed=speed)["bearings"]
        if isinstance(found, dict):
            return found[self.name]
        return next(row for row in found if row["name"] == self.name)

    def force(self, speed: Quantity | None = None) -> Matrix:
        """Force and moment on the shaft in the static equilibrium [N, N m], shape (6,)."""
        return np.asarray(self._at(speed)["force"], dtype=float)

    def analyse(
        self,
        load: Quantity | None = None,
        moment: Quantity | None = None,
        speed: Quantity | None = None,
        constrain: Sequence[str] | None = None,
        sweep: Sequence[str] = (),
        along: str | None = None,
        cage_average: bool = False,
        **settings: Any,
    ) -> BearingAnalysis:
        """The ball bearing by itself, as the command ``rotordyn bearing``: loads of balls, stiffness, film, lives, sweeps.

        ``load``: forces on it from the shaft, such as "0, -500, 100 N", by default those in the machine at rest;
        ``moment``: "0, 1 N m"; ``constrain``: held motions such as ``["theta_x", "theta_y"]``; ``sweep`` such as
        ``["load=0 N .. 2 kN", "speed"]``, ``along`` an axis. ``settings``: ``skidding`` and its loads and speeds.
        """
        given = {"load": load, "moment": moment, "speed": speed, "constrain": constrain or None, "along": along,
                 "cage_average": cage_average, **settings}
        return self._analysed(given, sweep, 3)

    def _analysed(self, given: dict[str, Any], sweep: Any, stacklevel: int) -> BearingAnalysis:
        sweeps = [sweep] if isinstance(sweep, str) else sweep
        if not isinstance(sweeps, (list, tuple)):
            raise InputError(f'sweep is a list such as ["load=0 N .. 2 kN"], not {sweep!r}')
        if "motion" in given:
            raise InputError("motion belongs to the command; here results are returned")
        flags_ = [*flags({"bearing": self.name, **given}), *(f"--sweep={words(one)}" for one in sweeps)]
        native = _native.bearings(self.model._native.parts, flags_)
        all_texts, known = native.warnings
        _warn(all_texts[known:], stacklevel)
        return BearingAnalysis(native, self.name)

    def stiffness(
        self, speed: Quantity | None = None, load: Quantity | None = None, moment: Quantity | None = None
    ) -> Matrix:
        """Tangent stiffness [N/m, N, N m/rad], shape (6, 6), order u_x u_y u_z theta_x theta_y theta_z.

        In the static equilibrium of the machine at a speed; with ``load`` such as "0, -500, 100 N" or ``moment`` of a ball
        bearing under that load from the shaft, as :meth:`analyse`.
        """
        if load is not None or moment is not None:
            out = np.zeros((6, 6))
            out[:5, :5] = self._analysed({"load": load, "moment": moment, "speed": speed}, (), 3).stiffness
            return out
        return np.asarray(self._at(speed)["stiffness"], dtype=float)

    def damping(self, speed: Quantity | None = None) -> Matrix:
        """Tangent damping in the static equilibrium at a speed [N s/m, N s, N m s/rad], shape (6, 6)."""
        return np.asarray(self._at(speed)["damping"], dtype=float)

    def __repr__(self) -> str:
        return f"<Bearing {self.name} of {self.model.name}>"


class _Bar:
    """Progress of a run-up in one line."""

    def __init__(self, out: TextIO) -> None:
        self._out, self._shown = out, -1

    def __call__(self, time: float, duration: float, speed_rpm: float) -> None:
        percent = int(100.0 * time / duration) if duration > 0.0 else 100
        if percent != self._shown:
            self._shown = percent
            print(f"\rrun-up: {time:.2f} of {duration:.2f} s, {speed_rpm:.0f} rpm, {percent} %", end="", file=self._out)
            self._out.flush()

    def close(self) -> None:
        if self._shown >= 0:
            print(file=self._out)
