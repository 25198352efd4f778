"""Ctrl-C within long calls: KeyboardInterrupt soon, the computation ends, and the interpreter goes on."""

from __future__ import annotations

import os
import signal
import threading
import time
import warnings
from typing import Any, Callable, Iterator

import numpy as np
import pytest

import rotordyn as rd
from conftest import load


def computing() -> bool:
    """Whether this process uses its processor time, though no thread of Python does."""
    before = time.process_time()
    time.sleep(0.1)
    return time.process_time() - before > 0.01


def wait(until: Callable[[], bool], longest: float) -> bool:
    end = time.monotonic() + longest
    while time.monotonic() < end:
        if until():
            return True
    return False


@pytest.fixture(autouse=True)
def ctrl_c_raises() -> Iterator[None]:
    # A shell that starts the tests in the background ignores Ctrl-C for them.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def measurement() -> rd.Measurement:
    """FRFs of thirty modes with noise: far more work than the test waits for."""
    random = np.random.default_rng(7)
    hz = np.arange(10.0, 1010.0, 0.25)
    s = 2j * np.pi * hz
    omega = 2 * np.pi * np.linspace(40.0, 980.0, 30)
    frf = np.zeros((40, 3, len(hz)), dtype=complex)
    for own in omega:
        residues = random.normal(size=(40, 1)) * random.normal(size=(1, 3))
        frf += (residues / own)[..., None] / ((s + 0.01 * own) ** 2 + own**2)
    frf += 1e-3 * abs(frf).mean() * (random.normal(size=frf.shape) + 1j * random.normal(size=frf.shape))
    return rd.Measurement(hz, frf, [f"{k + 1} x" for k in range(40)], ["1 x", "2 x", "3 x"], unit="m/N")


def fit(rig: rd.Model) -> Callable[[], Any]:
    """A fit of many parameters with their profiles."""
    free = [f"bearing.{name}.radial_clearance" for name in "AB"]
    free += ["disc.main.thickness", "disc.pulley.mass", "material.steel.young", "material.steel.density"]
    frf = rig.frf(speed="0 rpm", frequencies={"from": "10 Hz", "to": "300 Hz", "step": "0.5 Hz"})
    return lambda: rd.update(rig, frf, free, fit=["frequency", "damping", "mac", "frf-complex"], profile=free)


def test_ctrl_c_ends_long_calls() -> None:
    rig = load("overhung_rig.toml")
    expected = rig.modal(speed="900 rpm").eigenvalue
    speeds = {"from": "1 rpm", "to": "6000 rpm", "step": "3 rpm"}
    many = measurement()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        calls: dict[str, Callable[[], Any]] = {
            "identify": lambda: rd.identify(many),
            "update": fit(rig),
            "campbell": lambda: rig.campbell(speeds=speeds),
            "unbalance": lambda: rig.unbalance(speeds={**speeds, "step": "0.1 rpm"}),
        }
        for name, call in calls.items():

            def interrupt() -> None:
                assert wait(computing, 30.0)
                time.sleep(0.5)
                os.kill(os.getpid(), signal.SIGINT)

            pressing = threading.Thread(target=interrupt)
            pressing.start()
            with pytest.raises(KeyboardInterrupt):
                call()
                pytest.fail(f"{name} ended before Ctrl-C")
            pressing.join()
            assert wait(lambda: not computing(), 60.0), f"{name} goes on after Ctrl-C"
            assert np.array_equal(rig.modal(speed="900 rpm").eigenvalue, expected), name
