"""rotordyn: modes, Campbell diagrams, critical speeds, FRFs, unbalance responses and run-ups of rotors on ball bearings.

A model file describes the machine, with units in its values; every study is a method of the model::

    import rotordyn as rd
    rig = rd.load("models/overhung_rig.toml")
    rig["bearing.B.radial_clearance"] = "20 um"
    modes = rig.modal(speed="1200 rpm")
    modes.frequency_hz, modes.zeta
    rig.campbell(max_speed="6000 rpm").plot()

Speeds, lengths and all other quantities are texts with their units, as in the file; a number without unit is refused where
a unit is needed. Results have NumPy arrays under names that state their units. Errors are exceptions (:class:`Error`), what
restricts a result is a Python warning (:class:`RotordynWarning`).
"""

from __future__ import annotations

import json as _json
import os as _os
import sys as _sys
import sysconfig as _sysconfig
from typing import TYPE_CHECKING, Any

from . import _native, signal
from ._ross import from_ross
from ._values import words as _words
from .analysis import Analysis, BearingAnalysis, Identified, Measurement, Updated, identify, update
from .errors import Error, FileError, InputError, InternalError, PhysicsError, RotordynWarning
from .figure import Figure
from .model import Bearing, Matrices, Model, load
from .parallel import map, set_threads
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
from .runs import Orders, RunUp, Spectrograms
from .tree import Group, Table

if TYPE_CHECKING:
    from .parts import (
        BallBearing,
        Belt,
        Body,
        Bushing,
        Damping,
        Disc,
        Drive,
        FreeBallBearing,
        Housing,
        Joint,
        Layer,
        LinearBearing,
        Load,
        Lubricant,
        Material,
        Part,
        Probe,
        RadialBallBearing,
        RigidRotor,
        Section,
        Sensor,
        Shaft,
        ShaftUnbalance,
        SpeedProfile,
    )

__all__ = [
    "Analysis",
    "BallBearing",
    "Bearing",
    "BearingAnalysis",
    "Belt",
    "Body",
    "Bushing",
    "Campbell",
    "Critical",
    "CriticalMap",
    "Damping",
    "Disc",
    "Drive",
    "Error",
    "Figure",
    "FileError",
    "FreeBallBearing",
    "Frf",
    "Group",
    "Housing",
    "Identified",
    "InputError",
    "InternalError",
    "Joint",
    "Layer",
    "LinearBearing",
    "Load",
    "Lubricant",
    "Material",
    "Matrices",
    "Measurement",
    "Modal",
    "Model",
    "Orders",
    "Part",
    "PhysicsError",
    "Probe",
    "RadialBallBearing",
    "Result",
    "RigidRotor",
    "RotordynWarning",
    "RunUp",
    "Section",
    "Sensor",
    "Shaft",
    "ShaftUnbalance",
    "Spectrograms",
    "SpeedProfile",
    "Static",
    "Table",
    "Torsional",
    "Unbalance",
    "Updated",
    "catalogue",
    "from_ross",
    "identify",
    "load",
    "map",
    "set_threads",
    "signal",
    "update",
]

__version__: str = _native.version()


def catalogue(designation: str) -> dict[str, Any]:
    """Data sheet of a bearing of the catalogue, such as "6205": dimensions [m], ratings [N], orders.

    Raises :class:`InputError` for a designation that is not in it, with the nearest ones.
    """
    if not isinstance(designation, str) or not designation.strip():
        raise InputError(f'a designation is a text such as "6205", not {designation!r}')
    found: list[dict[str, Any]] = _json.loads(_native.catalogue(_words(designation.strip())))
    if len(found) > 1:
        known = [sheet["designation"] for sheet in found]
        shown = ", ".join(known[:12]) + (" ..." if len(known) > 12 else "")
        raise InputError(f"{designation!r} is the beginning of {len(known)} designations: {shown}")
    return found[0]


def __getattr__(name: str) -> Any:
    """Parts of models, which are read when they are used first."""
    if name == "parts" or name in __all__:
        import importlib

        found = importlib.import_module(".parts", __name__)
        return found if name == "parts" else getattr(found, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


def _find_program() -> str | None:
    """The command of this wheel, which reads HDF5 files in a process of its own."""
    name = _os.path.join(_sysconfig.get_path("scripts"), "rotordyn")
    return name if _os.access(name, _os.X_OK) and not _os.path.isdir(name) and _sys.platform != "win32" else None


_native.set_hdf5_program(_find_program())
