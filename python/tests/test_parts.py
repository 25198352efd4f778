"""Models in code: the keys of the reader's declarations, its checks, and the same numbers as a file."""

from __future__ import annotations

import inspect
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rotordyn as rd
from conftest import COMMAND, ROOT, as_module, load

make_parts = as_module(ROOT / "python" / "make_parts.py")


def jeffcott_in_code() -> rd.Model:
    linear: dict[str, Any] = dict(k_xx="2e7 N/m", k_yy="2e7 N/m", c_xx="500 N s/m", c_yy="500 N s/m")
    return rd.Model.build(
        "jeffcott",
        rd.Material("steel", young="210 GPa", poisson=0.3, density="7850 kg/m^3"),
        rd.Shaft(material="steel", element_length="50 mm", section=[rd.Section(length="800 mm", outer_diameter="20 mm")]),
        rd.Disc("main", station="disc", outer_diameter="200 mm", inner_diameter="20 mm", thickness="20 mm", material="steel"),
        rd.LinearBearing("A", station="A", k_zz="2e7 N/m", **linear),
        rd.LinearBearing("B", station="B", **linear),
        rd.ShaftUnbalance("disc", station="disc", grade="G6.3", speed="3000 rpm"),
        rd.Damping(modal={"frequency": "25 Hz", "ratio": 0.005}),
        rd.Drive(kind="prescribed", station="A"),
        rd.SpeedProfile(profile="s-curve", settle="0.5 s", ramp="6 s", hold="1 s", to="3000 rpm"),
        rd.Probe("disc_x", at="disc.main", direction="x"),
        rd.Probe("disc_y", at="disc.main", direction="y"),
        rd.Probe("A_vx", at="station.A", direction="x", quantity="velocity"),
        stations={"A": "0 mm", "disc": "400 mm", "B": "800 mm"},
        title="Jeffcott rotor",
        study={"modal": {"modes": 10}, "frf": {"frequencies": {"from": "1 Hz", "to": "300 Hz", "step": "0.25 Hz"}, "excitation": {"disc": {"at": "disc.main", "direction": "x"}}}},
    )


def test_the_same_bits_as_the_file(jeffcott: rd.Model) -> None:
    built = jeffcott_in_code()
    for study, settings in (
        ("modal", dict(speed="1200 rpm", modes=8)),
        ("campbell", dict(max_speed="6000 rpm", modes=10, orders=[1, 2])),
        ("critical", dict(max_speed="6000 rpm")),
        ("static", {}),
        ("unbalance", dict(max_speed="4000 rpm", speeds="500, 1000, 2000 rpm")),
    ):
        found, expected = (getattr(model, study)(**settings).to_dict() for model in (built, jeffcott))
        section = next(key for key in expected if key.replace("equilibrium", "static").startswith(study))
        assert found[section] == expected[section], study
    again = rd.Model.from_toml(built.to_toml())
    assert again.to_dict() == built.to_dict()
    built["disc.main.thickness"] = "25 mm"
    assert built["disc.main.thickness"] == "25 mm" and pickle.loads(pickle.dumps(built)) == built


def test_ball_bearings_of_the_catalogue() -> None:
    common: dict[str, Any] = dict(station="A", designation="6205")
    for kind in (rd.BallBearing, rd.RadialBallBearing, rd.FreeBallBearing):
        part = kind("A", **common)
        assert part.values["model"] == part._fixed["model"] and part.to_toml().startswith("[bearing.A]\n")
    model = rd.Model.build(
        "pump",
        rd.Material("steel", young="210 GPa", poisson=0.3, density="7850 kg/m^3"),
        rd.Shaft(element_length="50 mm", section=[{"length": "400 mm", "outer_diameter": "25 mm"}]),
        rd.BallBearing("A", preload={"force": "50 N"}, thrust="+z", **common),
        rd.BallBearing("B", station="B", designation="6205", preload={"force": "50 N"}, thrust="-z",
                       inner_waviness=[{"order": 7, "amplitude": "0.5 um"}]),
        stations={"A": "50 mm", "B": "350 mm"},
    )
    assert model.bearing("A").stiffness()[0, 0] > 1e6 and model["bearing.B.inner_waviness"][0]["order"] == 7


def test_checks_of_the_reader() -> None:
    with pytest.raises(rd.InputError) as caught:
        rd.Model.build("m", rd.Shaft(section=[rd.Section(length=800, outer_diameter="20 mm")]))  # type: ignore[arg-type]
    text = str(caught.value)
    assert "model m" in text and "length = 800" in text and "MissingUnit" in {p["kind"] for p in caught.value.problems}
    disc = rd.Disc("main")
    for wrong in (
        lambda: rd.Model.build("m", disc, disc),
        lambda: rd.Model.build("m", rd.Section()),
        lambda: rd.Model.build("m", "disc"),  # type: ignore[arg-type]
        lambda: rd.Model.build("m", rd.Part("x", {})),
        lambda: rd.Model.build("m", disc, stations=["A"]),  # type: ignore[arg-type]
        lambda: rd.Model.build("m", disc, study={"modal": 3}),
        lambda: rd.Model.build(3),  # type: ignore[arg-type]
        lambda: rd.Disc(3),  # type: ignore[arg-type]
        lambda: rd.Disc("main", thickness=object()).to_toml(),  # type: ignore[arg-type]
        lambda: rd.Shaft(section=[3]).to_toml(),  # type: ignore[list-item]
    ):
        with pytest.raises(rd.InputError):
            wrong()
    with pytest.raises(TypeError):
        rd.Disc("main", no_such_key=1)  # type: ignore[call-arg]


def test_parts_as_text() -> None:
    disc = rd.Disc("main", station="disc", mass="2 kg")
    assert disc.to_toml() == '[disc.main]\nstation = "disc"\nmass = "2 kg"\n'
    assert disc == rd.Disc("main", station="disc", mass="2 kg") != rd.Disc("main") and "mass='2 kg'" in repr(disc)
    assert rd.Disc("a b").to_toml() == '[disc."a b"]\n'
    assert rd.Section(from_="1 mm").values == {"from": "1 mm"}
    shaft = rd.Shaft(section=[rd.Section(length="1 mm"), rd.Section(length="2 mm")]).to_toml()
    assert shaft == '[[shaft.section]]\nlength = "1 mm"\n\n[[shaft.section]]\nlength = "2 mm"\n'


def test_classes_have_the_declared_keys() -> None:
    written = (ROOT / "python" / "rotordyn" / "parts.py").read_text(encoding="utf-8")
    assert make_parts.module_text(str(COMMAND)) == written, "run python/make_parts.py after a change of keys"
    for name, table, condition, named in make_parts.CLASSES:
        kind = getattr(rd, name)
        assert issubclass(kind, rd.Part) and (inspect.getdoc(kind) or "").count("``") > 2
        assert ("name" in inspect.signature(kind).parameters) == named
    assert Path(rd.parts.__file__).name == "parts.py"  # type: ignore[attr-defined]
    assert load("jeffcott.toml").name == "jeffcott"
