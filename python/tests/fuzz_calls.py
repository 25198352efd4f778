"""Calls of the public names with wrong values: exceptions only.

    python fuzz_calls.py SEED CALLS [FILE]     FILE: where the last call is written before it is made

A program of its own, so that an abort of the interpreter is a result: exit code 0 if every call returned or raised an
exception that is meant for the user.
"""

from __future__ import annotations

import gc
import os
import random
import sys
import tempfile
import traceback
import warnings
from pathlib import Path
from typing import Any, Callable

import numpy as np

import rotordyn as rd

MODELS = Path(__file__).resolve().parents[2] / "models"
#: What calls may raise: errors of the package, and those of Python for arguments and names that do not exist.
MEANT = (rd.InputError, rd.PhysicsError, rd.FileError, TypeError, KeyError, AttributeError, IndexError, ImportError)


class Draw:
    """Values, most of them wrong."""

    def __init__(self, seed: int) -> None:
        self._random = random.Random(seed)
        self.choice = self._random.choice
        self.random = self._random.random

    TEXTS = ["", " ", "0", "nan", "inf rpm", "-1 rpm", "1200 rpm", "1e999 rpm", "5 mm", "1e-300 mm", "3 Hz", "0 .. 0 Hz",
             "10 .. 200 Hz", "12 kHz", "\x00", "\ud800", "\u2126 m", "--json", "--help", "=", "a=b", "[x]", "\n[disc.y]", "'''", '"',
             "x" * 5000, "disc x", "A", "main", "modal", "base", "spherical", "6205", "62", "../../etc", "/", "0, -500, 0 N",
             "1 2 3 4 5 6 7", "receptance", "frequency", "bearing.A.k_xx", "housing.*.k_x", "..", "*", "1_000 rpm", "+- 30 %"]
    NUMBERS = [0, 1, -1, 3, 10**20, -(10**30), 0.5, -0.0, 1e-320, 1e308, float("nan"), float("inf"), 1j, True, False]

    def value(self, depth: int = 0) -> Any:
        kind = self._random.randrange(12 if depth < 3 else 4)
        if kind < 3:
            return self.choice(self.TEXTS)
        if kind == 3:
            return self.choice(self.NUMBERS)
        if kind == 4:
            return self.choice([None, object(), b"x", bytearray(3), {1}, range(3), print, Path("nowhere"), ..., rd, type])
        if kind == 5:
            return [self.value(depth + 1) for _ in range(self._random.randrange(4))]
        if kind == 6:
            return {self.choice(["a", "force", "", 3, "x.y"]): self.value(depth + 1) for _ in range(self._random.randrange(3))}
        if kind == 7:
            shape = tuple(self._random.randrange(4) for _ in range(self._random.randrange(4)))
            of = self.choice([float, complex, int, bool, "U3", object, np.float32, ">f8"])
            return np.zeros(shape, dtype=of)
        if kind == 8:
            return self.choice([np.float32(3), np.int8(1), np.nan, np.array("x"), np.arange(8.0)[::-2], np.datetime64("nat")])
        if kind == 9:
            return (self.value(depth + 1),)
        if kind == 10:
            return self.choice([rd.Disc("x"), rd.Shaft(), rd.Section(), rd.Damping()])
        return self.text()

    def text(self) -> str:
        return self.choice(self.TEXTS)

    def array(self) -> Any:
        """An array that could be a record."""
        size = self.choice([0, 1, 2, 7, 64, 500])
        found = np.random.default_rng(self._random.randrange(2**31)).standard_normal(size)
        if size and self.random() < 0.3:
            found[0] = self.choice([np.nan, np.inf, 1e308, -1e308])
        return self.choice([found, found * 1j, found.astype(np.float32), found[::-1], found.tolist(), found.reshape(-1, 1)])


PATHS = ["bearing.A.k_xx", "shaft.section.0.length", "shaft.section", "disc.main", "study.modal", "x", "bearing", "speed", "",
         "damping.modal.ratio", "station.disc", "material.steel.young", "a.b.c.d", "study.frf.speed", "model.name", "variant"]
STUDIES = ["static", "modal", "campbell", "critical", "critical_map", "torsional", "frf", "unbalance", "run_up"]
NAMES = ["speed", "max_speed", "modes", "orders", "quantity", "max_frequency", "speeds", "speed_range", "no_key", "fixed_cage_angle",
         "step", "integrator", "out", "progress"]


def calls(draw: Draw, rig: rd.Model, results: dict[str, Any], folder: Path) -> list[tuple[str, Callable[[], Any]]]:
    """The calls of which one is drawn."""
    v, t = draw.value, draw.text

    def keywords() -> dict[str, Any]:
        return {draw.choice(NAMES): v() for _ in range(draw.choice([0, 1, 1, 2]))}

    def settings() -> dict[str, Any]:
        names = ["band", "max_order", "quantity", "mapping", "force", "fit", "bounds", "prior", "iterations", "profile", "speed", "unit"]
        return {draw.choice(names): v() for _ in range(draw.choice([0, 1, 2]))}

    def setting() -> None:
        rig[draw.choice([*PATHS, t()])] = v()

    kind = draw.choice([name for name in rd.__all__ if isinstance(getattr(rd, name), type) and issubclass(getattr(rd, name), rd.Part)])
    of = results[draw.choice(list(results))]
    study = draw.choice([*STUDIES, t()])
    size = draw.choice([1, 2])
    frequency = np.linspace(1.0, 50.0, 40)
    frf = (np.ones((size, 1, 40)) + 1j) * draw.choice([0.0, 1.0, 1e300])
    names = [draw.choice(["disc x", "A y", "3 z", t()]) for _ in range(size)]
    return [
        ("load", lambda: rd.load(v())),
        ("load variant", lambda: rd.load(MODELS / "jeffcott.toml", variant=v())),
        ("from_toml", lambda: rd.Model.from_toml(draw.choice([v(), "[model]\nname = 1", "[shaft]"]), name=draw.choice(["m", v()]))),
        ("build", lambda: rd.Model.build(draw.choice(["m", v()]), v(), stations=v(), study=v(), title=v())),
        ("part", lambda: getattr(rd, kind)(v(), **{t() or "a": v()}).to_toml()),
        ("part values", lambda: rd.Disc(v(), station=v(), thickness=v()).to_toml()),
        ("set", setting),
        ("get", lambda: rig[draw.choice([*PATHS, v()])]),
        ("change", lambda: rig.change(draw.choice([v(), {draw.choice(PATHS): v()}]))),
        ("variant", lambda: rig.variant(v())),
        ("bearing", lambda: rig.bearing(draw.choice(["A", v()])).stiffness(speed=v())),
        ("bearing load", lambda: rig.bearing("A").analyse(load=v(), sweep=v())),
        ("matrices", lambda: rig.matrices(v())),
        ("study", lambda: getattr(rig, draw.choice(STUDIES[:-1]))(**keywords())),
        ("run_up", lambda: rig.run_up(step=v(), progress=v())),
        ("to_ross", lambda: rig.to_ross(v())),
        ("from_ross", lambda: rd.from_ross(v(), name=v())),
        ("catalogue", lambda: rd.catalogue(v())),
        ("map", lambda: rd.map(draw.choice([v(), [rig], [{draw.choice(PATHS): v()}]]), draw.choice([study, v()]), base=draw.choice([rig, v()]), **keywords())),
        ("threads", lambda: rd.set_threads(draw.choice([0, -1, t(), 2.5, None, 10**9]))),
        ("diagnose", lambda: rd.signal.diagnose(draw.choice([draw.array(), v()]), draw.choice([1000.0, v()]), bearing=v(), speed=v(), **{draw.choice(["band", "harmonics", "no"]): v()})),
        ("identify", lambda: rd.identify(v(), **settings())),
        ("measurement", lambda: rd.Measurement(v(), v(), v(), v(), unit=v())),
        ("identify frf", lambda: rd.identify(rd.Measurement(frequency, frf, names, ["disc x"], unit=draw.choice(["m/N", "", v()]), speed=draw.choice([None, t()])), model=draw.choice([None, rig]), **settings())),
        ("update", lambda: rd.update(draw.choice([rig, v()]), draw.choice([v(), rd.Measurement(frequency, frf, names, ["disc x"])]), draw.choice([["bearing.A.k_xx"], v()]), **settings())),
        ("result", lambda: of[draw.choice([v(), "frequency_hz", "modes"])]),
        ("attribute", lambda: getattr(of, t())),
        ("plot", lambda: of.plot(draw.choice([v(), None]), **({"backend": v()} if draw.random() < 0.3 else {}))),
        ("save", lambda: of.save(draw.choice([v(), folder / "none" / "x.h5", folder, "\x00"]))),
        ("unit", lambda: of.unit(v())),
        ("figure", lambda: rd.Figure("x", "<svg/>").save(draw.choice([v(), folder / "a.svg"]))),
        ("error", lambda: str(rd.InputError(v()))),
        ("delete", lambda: gc.collect()),
    ]


def main(seed: int, count: int, log: Path | None) -> int:
    draw = Draw(seed)
    outcomes: dict[str, int] = {"returned": 0, "refused": 0}
    with warnings.catch_warnings(), tempfile.TemporaryDirectory() as place:
        warnings.simplefilter("ignore")
        # Names of files that a call accepts are in this folder.
        os.chdir(place)
        rig = rd.load(MODELS / "jeffcott.toml")
        results: dict[str, Any] = {name: getattr(rig, name)() for name in ("static", "modal", "campbell", "critical", "frf", "unbalance")}
        del rig
        gc.collect()
        for k in range(count):
            model = rd.load(MODELS / "jeffcott.toml")
            every = calls(draw, model, results, Path(place))
            name, call = draw.choice(every)
            if log is not None:
                log.write_text(f"call {k} of seed {seed}: {name}\n", encoding="utf-8")
            try:
                call()
                outcomes["returned"] += 1
            except MEANT:
                outcomes["refused"] += 1
            except Exception as error:
                known = f"{name}: {type(error).__name__}: {error}"[:160]
                if known not in outcomes:
                    print(f"call {k} of seed {seed}: {known}", file=sys.stderr)
                    traceback.print_exception(error, limit=-3)
                outcomes[known] = 1
    print(f"{count} calls: {outcomes['returned']} returned, {outcomes['refused']} refused")
    unmeant = len(outcomes) - 2
    return 0 if unmeant == 0 and outcomes["refused"] > count / 4 else 1


if __name__ == "__main__":
    raise SystemExit(main(int(sys.argv[1]), int(sys.argv[2]), Path(sys.argv[3]) if len(sys.argv) > 3 else None))
