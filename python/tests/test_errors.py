"""Bad use: exceptions that say what to do, with the snippet."""

from __future__ import annotations

import pickle
import random
import threading
import warnings
from pathlib import Path
from typing import Any, Callable

import numpy as np
import pytest

import rotordyn as rd
from conftest import MODELS, load


def test_all_problems_of_a_text_with_snippets() -> None:
    text = (MODELS / "jeffcott.toml").read_text()
    spoiled = text.replace('"210 GPa"', "210e9").replace("thickness", "thicknes")
    with pytest.raises(rd.InputError) as caught:
        rd.Model.from_toml(spoiled, name="my.toml")
    error = caught.value
    assert isinstance(error, (rd.Error, ValueError))
    assert {"MissingUnit", "UnknownKey"} <= {problem["kind"] for problem in error.problems}
    assert "my.toml" in str(error) and "young = 210e9" in str(error) and "thicknes" in str(error)
    again = pickle.loads(pickle.dumps(error))
    assert str(again) == str(error) and again.problems == error.problems


@pytest.mark.parametrize(
    ("use", "part"),
    [
        (lambda rig: rig.modal(speed=1200), "rpm"),
        (lambda rig: rig.modal(speed="1200 kg"), "kg"),
        (lambda rig: rig.modal(speed=float("nan")), "nan"),
        (lambda rig: rig.modal(speed="fast"), "fast"),
        (lambda rig: rig.modal(modes="many"), "many"),
        (lambda rig: rig.modal(modes=-1), "-1"),
        (lambda rig: rig.modal(speeds=[1200]), "unit"),
        (lambda rig: rig.modal(no_such_key=1), "no_such_key"),
        (lambda rig: rig.modal(speed={"a": 1}), "known here: from, to"),
        (lambda rig: rig.modal(speed=object()), "text with its unit"),
        (lambda rig: rig.campbell(max_speed=6000), "rpm"),
        (lambda rig: rig.campbell(max_speed="-100 rpm"), "100"),
        (lambda rig: rig.critical(orders=[float("inf")]), "inf"),
        (lambda rig: rig.frf(quantity="speediness"), "speediness"),
        (lambda rig: rig.frf(max_frequency="3 rpm m"), "3 rpm m"),
        (lambda rig: rig.unbalance(max_speed=True), "text with its unit"),
        (lambda rig: rig.matrices(speed=100), "unit"),
        (lambda rig: rig.matrices(speed="1 m"), "speed"),
        (lambda rig: rig["bearing.C.k_xx"], "bearing"),
        (lambda rig: rig["bearing.A.k_xxx"], "k_xx"),
        (lambda rig: rig[3], "path"),
        (lambda rig: rig.variant("nothing"), "nothing"),
        (lambda rig: rig.variant(3), "variant"),
        (lambda rig: rig.bearing("Z"), "Z"),
        (lambda rig: rig.change([1]), "dictionary"),
        (lambda rig: rig.run_up(step=0.1), "unit"),
        (lambda rig: rig.modal().plot("nothing"), "there are"),
        (lambda rig: rig.modal().plot(backend="gnuplot"), "plotly"),
        (lambda rig: rig.frf()["a"], "a"),
    ],
)
def test_bad_use_of_studies(use: Callable[[rd.Model], Any], part: str, jeffcott: rd.Model) -> None:
    with pytest.raises((rd.InputError, KeyError)) as caught:
        use(jeffcott)
    assert part.lower() in str(caught.value).lower()


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("bearing.A.k_xx", 2e7),
        ("bearing.A.k_xx", "2e7 kg"),
        ("bearing.A.k_xx", float("nan")),
        ("bearing.A.k_xx", "nan N/m"),
        ("bearing.A.k_xx", None),
        ("bearing.A.k_xx", 1j),
        ("bearing.A.k_xx", np.zeros((2, 2))),
        ("bearing.A.k_xx", "2e7 N/m\n[disc]"),
        ("bearing.A.k_xx", "\udc80"),
        ("bearing.A.k_xx", 10**30),
        ("bearing.Q.k_xx", "2e7 N/m"),
        ("bearing.A.nothing", 1),
        ("", 1),
        ("a=b", 1),
        ("bearing..k_xx", 1),
        (".".join("a" * 100), 1),
        (7, 1),
    ],
)
def test_bad_changes(path: Any, value: Any, jeffcott: rd.Model) -> None:
    with pytest.raises(rd.InputError):
        jeffcott[path] = value
    assert jeffcott.changes == {}


def test_messages_show_the_changed_value_and_the_argument(jeffcott: rd.Model) -> None:
    with pytest.raises(rd.InputError) as caught:
        jeffcott["bearing.A.k_xx"] = "2e7 kg"
    assert 'bearing.A.k_xx="2e7 kg"' in str(caught.value) and "--set" not in str(caught.value)
    with pytest.raises(rd.InputError) as caught:
        jeffcott.campbell(max_speed=6000)
    assert 'max_speed="6000"' in str(caught.value) and "--max" not in str(caught.value)


def test_files(tmp_path: Path) -> None:
    with pytest.raises(rd.FileError) as caught:
        rd.load(tmp_path / "none.toml")
    assert "none.toml" in str(caught.value) and isinstance(caught.value, OSError)
    with pytest.raises(rd.InputError):
        rd.load(3)  # type: ignore[arg-type]
    with pytest.raises(rd.Error):
        rd.load(tmp_path)
    with pytest.raises(rd.InputError):
        rd.Model.from_toml(b"x")  # type: ignore[arg-type]
    with pytest.raises(rd.InputError):
        rd.Model.from_toml("\udc80")
    (tmp_path / "file").write_text("")
    with pytest.raises(rd.FileError):
        load("jeffcott.toml").modal().save(tmp_path / "file" / "results.h5")


def test_a_machine_without_solution() -> None:
    text = (MODELS / "jeffcott.toml").read_text()
    free = text.split("[bearing.A]")[0] + "[unbalance.disc]" + text.split("[unbalance.disc]")[1]
    with pytest.raises(rd.Error) as caught:
        rd.Model.from_toml(free).modal()
    assert isinstance(caught.value, (rd.PhysicsError, rd.InputError))


def test_a_result_outlives_its_model(jeffcott: rd.Model) -> None:
    modes = jeffcott.modal(speed="0 rpm")
    before = modes.frequency_hz.copy()
    jeffcott["disc.main.thickness"] = "40 mm"
    del jeffcott
    assert np.array_equal(modes.frequency_hz, before) and modes.plot().svg.startswith("<svg")


def test_a_model_changed_while_a_study_runs_in_another_thread(rig: rd.Model) -> None:
    alone = rig.modal(speed="900 rpm").eigenvalue
    found: list[Any] = []
    thread = threading.Thread(target=lambda: found.extend(rig.modal(speed="900 rpm") for _ in range(20)))
    thread.start()
    rig["bearing.B.radial_clearance"] = "15 um"
    changed = rig.modal(speed="900 rpm").eigenvalue
    thread.join()
    # Each of them is of the model as it was or as it is, none of a mixture.
    assert not np.array_equal(alone, changed)
    of = [np.array_equal(modes.eigenvalue, alone) or np.array_equal(modes.eigenvalue, changed) for modes in found]
    assert len(of) == 20 and all(of)


def test_fuzzed_calls_never_abort(jeffcott: rd.Model) -> None:
    draw = random.Random(20)
    words: list[Any] = ["1200 rpm", "0", "", "nan", "-1 rpm", "1e999 rpm", "5 mm", 3, -2, 0.5, float("nan"), None, True, [], {},
                        ["1 rpm", 2], "--json", "=", "\x00", "\u2126", 10**20, np.arange(3), np.nan, object(), b"x"]
    paths = ["bearing.A.k_xx", "shaft.section.0.length", "shaft.section", "disc.main", "study.modal", "x", "bearing", "speed",
             "damping.modal.ratio", "station.disc", "material.steel.young", "shaft.element_length", "a.b.c.d", "study.frf.speed"]
    studies = ["static", "modal", "campbell", "critical", "critical_map", "torsional", "frf", "unbalance", "matrices"]
    arguments = ["speed", "max_speed", "modes", "orders", "quantity", "max_frequency", "speeds", "speed_range", "no_key"]
    outcomes = {"returned": 0, "refused": 0}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for _ in range(1000):
            rig = jeffcott.copy()
            try:
                if draw.random() < 0.5:
                    rig[draw.choice(paths)] = draw.choice(words)
                    if draw.random() < 0.1:
                        rig.modal(speed="0 rpm", modes=2)
                else:
                    given = {draw.choice(arguments): draw.choice(words)}
                    if draw.choice(studies) == "matrices":
                        rig.matrices(draw.choice(words))
                    else:
                        getattr(rig, draw.choice(studies[:-1]))(**given)
                outcomes["returned"] += 1
            except (rd.InputError, rd.PhysicsError, TypeError):
                outcomes["refused"] += 1
    assert outcomes["returned"] > 20 and outcomes["refused"] > 200, outcomes
