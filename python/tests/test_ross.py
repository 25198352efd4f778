"""Rotors of ROSS, in and out. With the package ross-rotordynamics also live objects, else they are skipped."""

from __future__ import annotations

import json
import pickle
import subprocess
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rotordyn as rd
from conftest import COMMAND, ROOT, load

ROTORS = ROOT / "tests" / "data" / "ross" / "rotors"


@pytest.mark.parametrize("name", ["example_rotor.toml", "coupling.toml", "supports.toml", "v2_example_rotor.toml"])
def test_files_are_imported_as_by_the_command(name: str, tmp_path: Path) -> None:
    words = [COMMAND, "import", str(ROTORS / name), "-o", str(tmp_path / "machine.toml"), "--json", "--quiet"]
    done = json.loads(subprocess.run(words, capture_output=True, check=True).stdout)
    with warnings.catch_warnings(record=True) as given:
        warnings.simplefilter("always")
        model = rd.from_ross(ROTORS / name, name="machine")
    assert model.to_toml() == (tmp_path / "machine.toml").read_text()
    lost = [str(w.message.text) for w in given if getattr(w.message, "code", "") == "not-imported"]  # type: ignore[union-attr]
    assert lost == [f"{row['item']}: {row['why']}" for row in done["not_carried"]]
    assert all(Path(w.filename).name == "test_ross.py" for w in given)
    assert model.modal(speed="0 rpm").frequency_hz[0] > 0.0 and pickle.loads(pickle.dumps(model)) == model


def test_bad_use(tmp_path: Path) -> None:
    (tmp_path / "no.toml").write_text("x = 1\n")
    for use in (lambda: rd.from_ross(3), lambda: rd.from_ross(tmp_path / "no.toml"), lambda: rd.from_ross(rd.Model),
                lambda: rd.from_ross(ROTORS / "coupling.toml", name=3), lambda: rd.from_ross("\x00")):
        with pytest.raises((rd.InputError, rd.FileError)):
            use()
    with pytest.raises(rd.FileError):
        rd.from_ross(tmp_path / "none.toml")

    class Rotor:
        def save(self, path: str) -> None:
            pass

    with pytest.raises(rd.InputError, match="wrote no file"):
        rd.from_ross(Rotor())

    class Unsaved:
        def save(self, path: str) -> None:
            raise AttributeError("no attribute 'base_diameter'")

    with pytest.raises(rd.InputError, match="cannot save this Unsaved .*base_diameter"):
        rd.from_ross(Unsaved())
    jeffcott = load("jeffcott.toml")
    for wrong in ([], "0 rpm", ["0 rpm", "0 rpm"], ["1 m"], [3], None):
        with pytest.raises(rd.InputError):
            jeffcott.to_ross(wrong)  # type: ignore[arg-type]
    try:
        import ross  # type: ignore[import-not-found]  # noqa: F401
    except ImportError:
        with pytest.raises(ImportError, match="ross-rotordynamics"):
            jeffcott.to_ross()


def values(rotor: Any, speed: float) -> Any:
    """The lowest vibrations in the matrices of ROSS, as eigenvalues with a positive imaginary part."""
    M, C, G, K = rotor.M(speed), rotor.C(speed), rotor.G(), rotor.K(speed)
    n = len(M)
    D = C + speed * G
    A = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(M, K), -np.linalg.solve(M, D)]])
    found = np.linalg.eigvals(A)
    found = found[(found.imag > 1.0) & (found.imag > abs(found.real))]
    return found[np.argsort(found.imag)][:6]


@pytest.fixture(scope="module")
def ross() -> Any:
    return pytest.importorskip("ross")


NAMES = ["coupling.toml", "cone_hollow.toml", "example_rotor.toml", "example_with_damping.toml", "rotor_assembly_rotor1.json",
         "rotor_assembly_rotor2_bearing_mass.toml", "seals_over_speed.toml", "supports.toml"]


@pytest.mark.parametrize("name", [*NAMES, *(f"v2_{name}" for name in NAMES)])
def test_live_rotors_there_and_back(ross: Any, name: str) -> None:
    version = int(ross.__version__.split(".")[0])
    if not (ROTORS / name).exists() or (version < 3) != name.startswith("v2_"):
        pytest.skip(f"none of ROSS {version}")
    original = ross.Rotor.load(ROTORS / name)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        model = rd.from_ross(original)
        back = model.to_ross([f"{speed} rad/s" for speed in (0, 100, 200, 350, 500, 700)])
        for speed in (0.0, 350.0):
            for matrix in (lambda rotor: rotor.M(speed), lambda rotor: rotor.C(speed), lambda rotor: rotor.G(), lambda rotor: rotor.K(speed)):
                expected, found = matrix(original), matrix(back)
                # Lengths are differences of positions, which round.
                assert np.allclose(found, expected, rtol=1e-12, atol=1e-13 * abs(expected).max()), (name, speed)
            if name != "rotor_assembly_rotor1.json":  # without bearings
                own = model.modal(speed=f"{speed} rad/s", modes=30).eigenvalue
                near = [np.min(abs(own - value)) / abs(value) for value in values(original, speed)]
                # Cones: torsion and axial stiffness differ; else round-off of eigenvalues of large matrices.
                assert max(near) < (0.1 if "cone" in name else 1e-6), (name, speed, near)


def test_a_rig_with_ball_bearings_in_ross(ross: Any) -> None:
    rig = load("overhung_rig.toml")
    with pytest.warns(rd.RotordynWarning) as given:
        rotor = rig.to_ross(["0 rpm", "1200 rpm"])
    items = " ".join(w.message.item for w in given if isinstance(w.message, rd.RotordynWarning))
    assert "bearing.A" in items and all(w.message.code == "not-imported" for w in given)  # type: ignore[union-attr]
    assert len(rotor.bearing_elements) >= 2 and values(rotor, 0.0).size > 0
