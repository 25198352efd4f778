"""Results that are of no study of a machine: identified modes, updated models, bearings by themselves."""

from __future__ import annotations

import json as _json
import os
from typing import TYPE_CHECKING, Any, Callable, Mapping, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _native, tree
from ._quantities import Quantities
from ._values import array, file_path, flags, words, write
from .errors import InputError, RotordynWarning, _warn
from .figure import Figure
from .results import Frf, _dataset
from .tree import Group, Table

if TYPE_CHECKING:
    from .model import Model

__all__ = ["Analysis", "BearingAnalysis", "Identified", "Measurement", "Updated", "identify", "update"]

Path = Union[str, "os.PathLike[str]"]


class Analysis(Quantities):
    """What an analysis found: its quantities are attributes, see :class:`rotordyn.Group`. It can be pickled."""

    def __init__(self, native: Any) -> None:
        self._native = native
        self._content: Any = None
        self._drawn: dict[str, str] | None = None

    def _read(self) -> Any:
        return tree.of_fields(self._native.fields())

    @property
    def _group(self) -> Any:
        if self._content is None:
            self._content = self._read()
        return self._content

    def unit(self, name: str) -> str:
        """Unit of a quantity."""
        return str(self._group.unit(name))

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
        return str(self._native.json())

    def save(self, path: Path) -> None:
        """Writes the results file (HDF5) of the command."""
        self._native.save(file_path("save", path))

    @property
    def figures(self) -> list[str]:
        """Names of the figures."""
        return list(self._svg())

    def _svg(self) -> dict[str, str]:
        if self._drawn is None:
            self._drawn = dict(self._native.figures())
        return self._drawn

    def plot(self, name: str | None = None) -> Figure:
        """A figure: the first one, or one of ``figures`` by its name."""
        drawn = self._svg()
        wanted = next(iter(drawn), "") if name is None else name
        if not isinstance(wanted, str) or wanted not in drawn:
            raise InputError(f"there is no figure {wanted!r}; there are: {', '.join(drawn)}")
        return Figure(wanted, drawn[wanted])

    def _repr_html_(self) -> str | None:
        return next(iter(self._svg().values()), None)

    def to_pandas(self) -> Any:
        """The main table as a pandas DataFrame; needs pandas."""
        tables = [self._group[name] for name in self.keys()]
        table = next((found for found in tables if isinstance(found, Table)), None)
        if table is None:
            raise InputError("these results have no table")
        return table.to_pandas()

    def to_xarray(self) -> Any:
        """The arrays over their axes as an xarray Dataset; needs xarray."""
        return _dataset(self._group)

    def __repr__(self) -> str:
        return tree._described(type(self).__name__, self._group)

    def __reduce__(self) -> Any:
        return _restored, (type(self), _Kept.of(self._native), self._more())

    def _more(self) -> dict[str, Any]:
        """Attributes beside the native results."""
        return {}


def _restored(kind: type[Analysis], kept: _Kept, more: dict[str, Any]) -> Analysis:
    found = object.__new__(kind)
    Analysis.__init__(found, kept)
    found.__dict__.update(more)
    return found


class _Kept:
    """Results after a pickle: what the native part told of them."""

    def __init__(self, told: dict[str, Any]) -> None:
        self._told = told

    @classmethod
    def of(cls, native: Any) -> _Kept:
        if isinstance(native, _Kept):
            return native
        told = {name: getattr(native, name)() for name in ("fields", "sections", "json", "figures")}
        told["warnings"] = native.warnings
        told["file"], told["shapes"] = _bytes(native.save, "results.h5"), None
        if isinstance(told["fields"], list) and not told["sections"]:
            try:
                told["shapes"] = _bytes(native.save_shapes, "modes.uff")
            except InputError:
                pass
        return cls(told)

    def fields(self) -> Any:
        return self._told["fields"]

    def sections(self) -> Any:
        return self._told["sections"]

    def json(self) -> Any:
        return self._told["json"]

    def figures(self) -> Any:
        return self._told["figures"]

    @property
    def warnings(self) -> Any:
        return self._told["warnings"]

    def save(self, path: str) -> None:
        write(path, self._told["file"])

    def save_shapes(self, path: str) -> None:
        if self._told["shapes"] is None:
            raise InputError("there is no mode to be saved")
        write(path, self._told["shapes"])


def _folder() -> Any:
    """A folder that is removed at the end."""
    import tempfile

    return tempfile.TemporaryDirectory(prefix="rotordyn")


def _bytes(save: Callable[[str], None], name: str) -> bytes:
    """What a function writes to a file."""
    with _folder() as folder:
        path = os.path.join(folder, name)
        save(path)
        with open(path, "rb") as file:
            return file.read()


class Measurement:
    """Measured FRFs in arrays, for :func:`rotordyn.identify` and :func:`rotordyn.update`.

    ``frequency_hz`` [Hz], shape (lines,); ``frf`` complex, (responses, references, lines), in ``unit`` such as
    "(m/s^2)/N", "g/N" or "m/N"; ``coherence`` with the same shape. ``responses`` and ``references`` name a point and a
    direction each: "disc x", "B -y", "rim theta_z"; points are numbers, or places of the model that is updated.
    ``speed``: of the shaft, such as "1200 rpm".
    """

    def __init__(
        self,
        frequency_hz: npt.ArrayLike,
        frf: npt.ArrayLike,
        responses: Sequence[str],
        references: Sequence[str],
        unit: str = "",
        coherence: npt.ArrayLike | None = None,
        speed: str | None = None,
    ) -> None:
        self.frequency_hz = _array("frequency_hz", frequency_hz, np.float64, 1)
        self.frf = _array("frf", frf, np.complex128, 3)
        self.responses, self.references = _names("responses", responses), _names("references", references)
        self.coherence = None if coherence is None else _array("coherence", coherence, np.float64, 3)
        expected = (len(self.responses), len(self.references), len(self.frequency_hz))
        for name, given in (("frf", self.frf), ("coherence", self.coherence)):
            if given is not None and given.shape != expected:
                raise InputError(
                    f"{name} has the shape {given.shape}; {len(self.responses)} responses, {len(self.references)} "
                    f"references and {len(self.frequency_hz)} frequencies need {expected}"
                )
        if len(self.frequency_hz) < 2 or not np.all(np.diff(self.frequency_hz) > 0.0):
            raise InputError("frequency_hz must be two or more frequencies, increasing")
        if not isinstance(unit, str):
            raise InputError(f'unit: a text such as "(m/s^2)/N", not {unit!r}')
        self.unit = words(unit)
        self.speed = None if speed is None else words(speed)

    def __repr__(self) -> str:
        band = f"{self.frequency_hz[0]:g} to {self.frequency_hz[-1]:g} Hz"
        return f"<Measurement of {len(self.responses)} x {len(self.references)} FRFs [{self.unit}], {band}>"

    def _in_native(self, model: Model | None) -> _native.Measured:
        source = None if model is None else model._native
        return _native.Measured.frfs(
            self.frequency_hz, self.frf, self.responses, self.references, self.unit, self.coherence, self.speed, source
        )


def _array(name: str, given: npt.ArrayLike, kind: Any, dimensions: int) -> npt.NDArray[Any]:
    found = array(name, given, kind)
    if found.ndim != dimensions:
        raise InputError(f"{name} has {dimensions} dimension{'s' * (dimensions > 1)}, this array has the shape {found.shape}")
    if found.size == 0:
        raise InputError(f"{name} is empty")
    if not np.all(np.isfinite(found)):
        raise InputError(f"{name} has numbers that are not finite: leave those lines out")
    return found


def _names(what: str, given: Sequence[str]) -> list[str]:
    if isinstance(given, str) or not isinstance(given, (list, tuple)) or not all(isinstance(name, str) for name in given):
        raise InputError(f'{what} are a list of points with a direction, such as ["disc x", "B y"], not {given!r}')
    return [words(name) for name in given]


Measured = Union[Path, Sequence[Path], Frf, Measurement]


class Identified(Analysis):
    """Modes of a measurement: ``modes`` with ``frequency_hz`` [Hz], ``damping_ratio`` and the standard error of each.

    ``modes.shape`` and ``modes.participation`` are complex over ``responses`` and ``references``; ``fit_error``,
    ``auto_mac``, ``stabilisation``. Of a record of a machine in operation: ``modes``, ``channels``, ``spectrum``.
    """

    @property
    def frequency_hz(self) -> npt.NDArray[np.float64]:
        """Damped natural frequencies [Hz], shape (modes,)."""
        return np.asarray(self._group["modes"]["frequency_hz"], dtype=float)

    @property
    def zeta(self) -> npt.NDArray[np.float64]:
        """Damping ratios, shape (modes,)."""
        return np.asarray(self._group["modes"]["damping_ratio"], dtype=float)

    def __len__(self) -> int:
        return len(self._group["modes"])

    def save_shapes(self, path: Path) -> None:
        """Writes the mode shapes as a universal file (dataset 55)."""
        self._native.save_shapes(file_path("save_shapes", path))


class Updated(Analysis):
    """A fit of free parameters: ``parameters`` with value, standard error and identifiability; ``chi_squared``, ...

    ``model`` is the model with the updated values, ``values`` these as they are written, by their path. Parameters that the
    data do not determine keep their values.
    """

    def __init__(self, native: _native.Analysis, model: Model) -> None:
        super().__init__(native)
        self.values: dict[str, str] = {path: text for path, text, _ in native.changes()}
        self.model: Model = _updated(native, model)

    def _more(self) -> dict[str, Any]:
        return {"model": self.model, "values": self.values}


def _updated(native: _native.Analysis, model: Model) -> Model:
    changes = native.changes()
    if model.changes:
        return model.with_changes({path: text if quoted else float(text) for path, text, quoted in changes})
    text = native.updated_text(model._native)
    return model._with_text(text)


class BearingAnalysis(Analysis):
    """A ball bearing under its load: ``operating`` (deflections, ball loads, stiffness, lives), ``limits``, ``sweeps``, ...

    ``stiffness`` [N/m, N, N m/rad] is the tangent, shape (5, 5), for u_x u_y u_z theta_x theta_y.
    """

    def __init__(self, native: Any, name: str) -> None:
        super().__init__(native)
        self._name = name

    def _read(self) -> Any:
        found = [tree.of_fields(fields) for fields in self._native.sections().get("bearings", [])]
        return next((group for group in found if group["name"] == self._name), Group([]))

    def _more(self) -> dict[str, Any]:
        return {"_name": self._name}

    @property
    def stiffness(self) -> npt.NDArray[np.float64]:
        """Tangent stiffness at the operating point [N/m, N, N m/rad], shape (5, 5): u_x u_y u_z theta_x theta_y."""
        return np.asarray(self._group["operating"]["stiffness"], dtype=float)


#: Flags of ``identify`` without which FRFs in memory would be read from a file.
_PLACE = "measurement"


def identify(
    measured: Measured,
    *,
    model: Model | None = None,
    mapping: Path | None = None,
    band: str | None = None,
    max_order: int | None = None,
    quantity: str | None = None,
    exponential_window: str | None = None,
    **settings: Any,
) -> Identified:
    """Modes of measured FRFs, of hammer-test records, or of a machine in operation, with their standard errors.

    ``measured``: a file or several (UFF, MATLAB, NumPy, CSV, HDF5, results.h5), an :class:`Frf` or a :class:`Measurement`.
    ``band`` such as "10 .. 200 Hz"; ``quantity`` of FRFs without a unit: receptance, mobility, accelerance;
    ``exponential_window``: its time constant, whose damping is subtracted; it is applied to time records, unless
    ``already_windowed=True``, and not to FRFs; ``mapping``: a file that names stations and
    directions of channels, ``model``: the machine of these stations. ``settings`` are other flags of the command
    ``rotordyn identify``, such as ``force="hammer"``, ``speed="1200 rpm"`` or ``channels=["A_x", "A_y"]``.
    """
    _model(model)
    given = {"band": band, "max_order": max_order, "quantity": quantity, "exponential_window": exponential_window}
    named = [f"--mapping={file_path('mapping', mapping)}"] if mapping is not None else []
    files, native = _files(measured, model)
    words_ = [*flags({**given, **settings}), *named, "--", *files]
    source = None if model is None else model._native
    found = Identified(_native.identify(words_, native, source))
    _warn(found._native.warnings[0], 2)
    return found


def update(
    model: Model,
    measured: Union[Measured, Identified],
    free: Union[str, Sequence[str]],
    *,
    bounds: Mapping[str, str] | None = None,
    prior: Mapping[str, str] | None = None,
    fit: Union[str, Sequence[str], None] = None,
    mapping: Path | None = None,
    band: str | None = None,
    speed: str | None = None,
    profile: Union[str, Sequence[str], None] = None,
    **settings: Any,
) -> Updated:
    """Fits values of the model to measured modes or FRFs; returns what the data say of each.

    ``free``: paths such as ``["housing.B.k_x", "housing.*.k_y"]``; ``bounds={"housing.B.k_x": "1e6 .. 1e8 N/m"}``,
    ``prior={"housing.B.k_x": "+- 30 %"}``; ``fit``: frequency, damping, mac, frf, frf-complex. ``measured`` as in
    :func:`identify`, or identified modes at points of the model. ``settings`` are other flags of the command
    ``rotordyn update``, such as ``frequency_accuracy=0.2`` [%], ``frf_accuracy``, ``iterations``.
    """
    _model(model, needed=True)
    _measured: Any = measured
    with _folder() as folder:
        native: _native.Measured | None
        if not isinstance(measured, Identified):
            files, native = _files(_measured, model)
        elif isinstance(measured._native, _Kept):
            # After a pickle there are the shapes as a file has them.
            files, native = [os.path.join(folder, "modes.uff")], None
            measured.save_shapes(files[0])
        else:
            files, native = [_PLACE], _native.Measured.of_modes(measured._native)
        words_ = _update_words(files, free, bounds, prior, mapping, {"fit": fit, "band": band, "speed": speed, "profile": profile}, settings)
        found = Updated(_native.update(model._native, words_, native), model)
    _warn(found._native.warnings[0], 2)
    return found


def _update_words(
    files: list[str], free: Any, bounds: Any, prior: Any, mapping: Any, given: dict[str, Any], settings: Mapping[str, Any]
) -> list[str]:
    """Arguments of the command `update`."""
    words_ = flags({"free": free, **given, **settings})
    for name, values in (("bounds", bounds), ("prior", prior)):
        if values is not None and not isinstance(values, Mapping):
            raise InputError(f'{name} are a dictionary such as {{"housing.B.k_x": "1e6 .. 1e8 N/m"}}, not {values!r}')
        words_ += [f"--{name}={words(key)}={words(value)}" for key, value in (values or {}).items()]
    if mapping is not None:
        words_.append(f"--mapping={file_path('mapping', mapping)}")
    return [*words_, *(f"--measured={file}" for file in files)]


def _model(model: Any, needed: bool = False) -> None:
    from .model import Model

    if not isinstance(model, Model) and (needed or model is not None):
        raise InputError(f"the model is one of rd.load or rd.Model, not {model!r}")


def _files(measured: Any, model: Model | None) -> tuple[list[str], _native.Measured | None]:
    """Names of files, and what takes the place of the only one."""
    if isinstance(measured, Frf):
        return [_PLACE], _native.Measured.of_frf(measured._native)
    if isinstance(measured, Measurement):
        return [_PLACE], measured._in_native(model)
    if isinstance(measured, (list, tuple)):
        if not measured:
            raise InputError("there is no file to identify")
        return [file_path("measured", path) for path in measured], None
    if not isinstance(measured, (str, os.PathLike)):
        raise InputError(f"measured: a file, a list of files, an Frf or a Measurement, not {measured!r}")
    return [file_path("measured", measured)], None
