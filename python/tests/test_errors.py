"""Bad use: exceptions that say what to do, with the snippet."""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
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


def test_a_model_changed_while_a_run_up_goes_on_in_another_thread(jeffcott: rd.Model) -> None:
    short = {"speed.settle": "0.1 s", "speed.ramp": "0.5 s", "speed.hold": "0.1 s"}
    rig = jeffcott.with_changes(short)
    alone = rig.run_up()["disc_x"]
    found: list[Any] = []
    going = threading.Event()
    thread = threading.Thread(target=lambda: found.append(rig.run_up(progress=lambda *_: going.set())))
    thread.start()
    going.wait(30.0)
    rig["disc.main.thickness"] = "40 mm"
    del rig
    thread.join()
    assert np.array_equal(found[0]["disc_x"], alone)


def test_calls_with_wrong_values_raise_exceptions_only(tmp_path: Path) -> None:
    """Of the 10 000 calls of a long run (ROTORDYN_FUZZ_CALLS=10000) the first ones."""
    count = os.environ.get("ROTORDYN_FUZZ_CALLS", "500")
    words = [sys.executable, "-X", "faulthandler", str(Path(__file__).parent / "fuzz_calls.py"), "20", count, str(tmp_path / "last")]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 0, (tmp_path / "last").read_text() + done.stdout + done.stderr[-4000:]
