"""Rotors of ROSS: in, by the file that ROSS saves, and out, in its elements."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING, Any, Sequence, Union

from . import _native
from ._values import file_path, words
from .errors import InputError, _warn
from .tree import _needed

if TYPE_CHECKING:
    from .model import Model

__all__ = ["from_ross"]


def from_ross(rotor: Any, name: str | None = None) -> Model:
    """The model of a rotor of ROSS 2 or 3: a ``ross.Rotor``, or the path of a file that it saved.

    What has no counterpart is a warning ``not-imported`` each, with its name and why. ``name``: that of the model. It is the
    model that ``rotordyn import`` writes; node k of ROSS is the station ``nk``.
    """
    if isinstance(rotor, (str, os.PathLike)):
        path = file_path("from_ross", rotor)
        stem = os.path.splitext(os.path.basename(path))[0]
        return _imported(path, stem if name is None else name)
    save = getattr(rotor, "save", None)
    if not callable(save) or isinstance(rotor, type):
        raise InputError(f"a ross.Rotor or the path of a file that it saved, not {rotor!r}")
    import tempfile

    with tempfile.TemporaryDirectory(prefix="rotordyn") as folder:
        path = os.path.join(folder, "rotor.toml")
        try:
            save(path)
        except Exception as error:
            kind, why = type(rotor).__name__, f"{type(error).__name__}: {error}"
            raise InputError(f"ROSS cannot save this {kind} ({why}); only what it saves can be imported") from error
        if not os.path.isfile(path):
            raise InputError(f"{type(rotor).__name__}.save wrote no file: a ross.Rotor is needed")
        return _imported(path, str(getattr(rotor, "tag", None) or "rotor") if name is None else name)


def _imported(path: str, name: str) -> Model:
    from .model import Model

    if not isinstance(name, str):
        raise InputError(f"the name of a model is a text, not {name!r}")
    text, _, _, lost = _native.import_ross(words(path), words(name))
    _warn(lost, 3)
    return Model(_native.Source.of_text(text.encode(), f"model of {name}", "", None, []), _stacklevel=4)


def to_ross(model: Model, speeds: Sequence[str]) -> Any:
    """The rotor of a model with its bearings at some speeds."""
    if isinstance(speeds, str) or not isinstance(speeds, (list, tuple)) or not speeds:
        raise InputError(f'speeds are a list such as ["0 rpm", "3000 rpm"], not {speeds!r}')
    found = json.loads(_native.ross_elements(model._native, [words(speed) for speed in speeds]))
    order = sorted(range(len(speeds)), key=lambda k: found["speeds"][k])
    if any(found["speeds"][a] == found["speeds"][b] for a, b in zip(order, order[1:])):
        raise InputError("a speed is given twice")
    ross = _needed("ross", "ross-rotordynamics")
    materials: dict[str, Any] = {}
    shaft = []
    for row in found["shaft"]:
        of = row.pop("material")
        key = json.dumps(of)
        if key not in materials:
            # Names of ROSS have no spaces.
            materials[key] = ross.Material(**{**of, "name": of["name"].replace(" ", "_")})
        shaft.append(ross.ShaftElement(**row, material=materials[key]))
    discs = [ross.DiskElement(**row) for row in found["discs"]]
    masses = [ross.PointMass(**row) for row in found["supports"]]
    at = [found["speeds"][k] for k in order]
    bearings = [_bearing(ross, row, order, at) for row in found["bearings"]]
    for row in found["masses"]:
        # A point mass of ROSS is a node of its own; a bearing has its mass on the shaft.
        own = {"m" + axis + axis: row["m" + axis] for axis in "xyz"}
        bearings.append(ross.BearingElement(n=row["n"], kxx=0.0, cxx=0.0, tag=row["tag"], **own))
    shaft += [_coupling(ross, row) for row in found["couplings"]]
    lost = list(found["lost"])
    alpha_beta = {name: found[name] for name in ("alpha", "beta") if found[name]}
    try:
        rotor = ross.Rotor(shaft, discs, bearings, masses, **alpha_beta, tag=found["title"])
    except TypeError:
        # ROSS 2 has no damping of the whole rotor.
        lost.append(("damping", "alpha and beta of the whole rotor need ROSS 3"))
        rotor = ross.Rotor(shaft, discs, bearings, masses, tag=found["title"])
    advice = "see the text of the warning"
    _warn([("not-imported", "caution", item, f"not carried over to ROSS: {why}", advice) for item, why in lost], 3)
    return rotor


def _bearing(ross: Any, row: Any, order: list[int], at: list[float]) -> Any:
    """A bearing with its coefficients over the speeds, or constant ones."""
    k, c = row["k"], row["c"]
    constant = len(k) == 1 or (all(m == k[0] for m in k) and all(m == c[0] for m in c))
    places = {"xx": (0, 0), "xy": (0, 1), "yx": (1, 0), "yy": (1, 1), "zz": (2, 2)}
    given: dict[str, Any] = {}
    for name, (a, b) in places.items():
        for letter, all_ in (("k", k), ("c", c)):
            given[letter + name] = all_[0][a][b] if constant else [all_[i][a][b] for i in order]
    if not constant:
        import inspect

        # ROSS 3 tells the speed of rotation from the whirl frequency.
        known = inspect.signature(ross.BearingElement.__init__).parameters
        given["speed" if "speed" in known else "frequency"] = at
    return ross.BearingElement(n=row["n"], n_link=row["n_link"], tag=row["tag"], **given)


def _coupling(ross: Any, row: Any) -> Any:
    names = ("t_x", "t_y", "t_z", "r_x", "r_y", "r_z")
    given = {letter + name: value for letter in "kc" for name, value in zip(names, row[letter])}
    return ross.CouplingElement(
        m_l=0.0, m_r=0.0, Ip_l=0.0, Ip_r=0.0, n=row["n"], o_d=row["o_d"], L=row["L"], tag=row["tag"], **given
    )
