"""Models: read, changed, written out, copied."""

from __future__ import annotations

import copy
import pickle
import warnings
from pathlib import Path

import numpy as np
import pytest

import rotordyn as rd
from conftest import MODELS, load


def test_names_and_variants(rig: rd.Model) -> None:
    assert rig.name == "overhung_rig" and "spherical" in rig.variants
    assert "overhung_rig" in repr(rig)
    spherical = rig.variant("spherical")
    assert spherical != rig and spherical.variant("base") == rig
    assert rd.load(MODELS / "overhung_rig.toml", variant="spherical") == spherical


def test_values_are_read_and_changed_by_path(jeffcott: rd.Model) -> None:
    assert jeffcott["bearing.A.k_xx"] == "2e7 N/m"
    assert jeffcott["damping.modal.ratio"] == 0.005
    assert jeffcott["shaft.section.0.length"] == "800 mm"
    assert jeffcott["disc.main"]["station"] == "disc"
    before = jeffcott.modal(speed="0 rpm").frequency_hz[0]
    jeffcott["disc.main.thickness"] = "40 mm"
    assert jeffcott["disc.main.thickness"] == "40 mm" and jeffcott.changes == {"disc.main.thickness": '"40 mm"'}
    assert jeffcott.modal(speed="0 rpm").frequency_hz[0] < 0.8 * before


def test_value_by_default(rig: rd.Model) -> None:
    assert "cage_pocket_diameter" not in rig["bearing.A"]
    # Wider than the ball of a 6205, which has 7.94 mm.
    number, unit = rig["bearing.A.cage_pocket_diameter"].split()
    assert unit == "mm" and 7.94 < float(number) < 9.0


def test_numpy_values_and_lists(jeffcott: rd.Model) -> None:
    jeffcott["damping.modal.ratio"] = np.float64(0.01)
    assert jeffcott["damping.modal.ratio"] == 0.01
    jeffcott["study.campbell.orders"] = np.array([1, 2])
    assert jeffcott["study.campbell.orders"] == [1, 2]


def test_several_changes_at_once(jeffcott: rd.Model) -> None:
    jeffcott.change({"bearing.A.k_xx": "1e7 N/m", "bearing.A.k_yy": "1e7 N/m"})
    other = jeffcott.with_changes({"bearing.A.k_xx": "3e7 N/m"})
    assert (jeffcott["bearing.A.k_xx"], other["bearing.A.k_xx"]) == ("1e7 N/m", "3e7 N/m")


def test_a_refused_change_leaves_the_model(jeffcott: rd.Model) -> None:
    before = jeffcott.to_toml()
    with pytest.raises(rd.InputError):
        jeffcott["bearing.A.k_xx"] = "2e7 kg"
    assert jeffcott.to_toml() == before and jeffcott.changes == {}


def test_text_as_it_stands(rig: rd.Model, tmp_path: Path) -> None:
    assert rig.to_toml() == (MODELS / "overhung_rig.toml").read_text()
    changed = rig.variant("wavy")
    changed["bearing.B.radial_clearance"] = "20 um"
    changed.save(tmp_path / "changed.toml")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        again = rd.load(tmp_path / "changed.toml")
        same = rd.Model.from_toml(changed.to_toml(), folder=MODELS)
    expected = changed.modal(speed="600 rpm").eigenvalue
    assert np.array_equal(again.modal(speed="600 rpm").eigenvalue, expected)
    assert np.array_equal(same.modal(speed="600 rpm").eigenvalue, expected)
    assert again.to_dict() == changed.to_dict()


@pytest.mark.parametrize("name", sorted(path.name for path in MODELS.glob("*.toml")))
def test_every_model_and_variant_written_out_is_the_same(name: str) -> None:
    if name == "cwru_6205.toml":
        pytest.skip("bearings without a machine")
    model = load(name)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for variant in model.variants[:4]:
            one = model.variant(variant)
            again = rd.Model.from_toml(one.to_toml(), folder=MODELS)
            assert again.to_dict() == one.to_dict()


def test_copies_and_pickles(rig: rd.Model) -> None:
    rig["bearing.B.radial_clearance"] = "20 um"
    for other in (copy.copy(rig), copy.deepcopy(rig), rig.copy(), pickle.loads(pickle.dumps(rig))):
        assert other == rig
        other["bearing.B.radial_clearance"] = "30 um"
        assert other != rig and rig["bearing.B.radial_clearance"] == "20 um"


def test_warnings_of_the_file_are_given_once() -> None:
    spoiled = (MODELS / "jeffcott.toml").read_text().replace("7850 kg/m^3", "785 kg/m^3")
    with pytest.warns(rd.RotordynWarning) as found:
        model = rd.Model.from_toml(spoiled)
    first = found[0].message
    assert isinstance(first, rd.RotordynWarning)
    assert first.code and first.severity in ("caution", "serious") and first.text in str(first)
    assert Path(found[0].filename).name == "test_models.py"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        model["disc.main.thickness"] = "30 mm"
    model = load("jeffcott.toml")
    del_axial = model.with_changes({"bearing.A.k_zz": "0 N/m"})
    with pytest.warns(rd.RotordynWarning) as found:
        del_axial.modal(speed="0 rpm")
    assert all(Path(one.filename).name == "test_models.py" for one in found)


def test_catalogue() -> None:
    sheet = rd.catalogue("6205")
    assert sheet["designation"] == "6205" and sheet["balls"] == 9
    with pytest.raises(rd.InputError, match="nearest"):
        rd.catalogue("6299999")
    with pytest.raises(rd.InputError, match="beginning of"):
        rd.catalogue("62")
    with pytest.raises(rd.InputError, match="designation"):
        rd.catalogue(6205)  # type: ignore[arg-type]
