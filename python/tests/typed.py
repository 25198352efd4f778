"""A program that uses the module, checked by mypy in strict mode."""

import numpy as np
import numpy.typing as npt

import rotordyn as rd


def first_frequency(path: str) -> float:
    rig: rd.Model = rd.load(path)
    rig["bearing.B.radial_clearance"] = "20 um"
    modes = rig.modal(speed="1200 rpm", modes=4)
    frequencies: npt.NDArray[np.float64] = modes.frequency_hz
    M, C, G, K = rig.matrices(speed="1200 rpm")
    assert M.shape == C.shape == G.shape == K.shape
    figure: rd.Figure = rig.campbell(max_speed="6000 rpm").plot()
    run: rd.RunUp = rig.run_up(progress=lambda time, duration, speed: None)
    level = float(np.abs(run["B_ax"]).max())
    found = rd.signal.diagnose(run["B_ax"], 2000.0, bearing="6205", speed="1200 rpm")
    print(figure.name, level, found.keys())
    return float(frequencies[0])


def fitted(path: str) -> rd.Model:
    rig = rd.Model.build(
        "rig",
        rd.Material("steel", young="210 GPa", poisson=0.3, density="7850 kg/m^3"),
        rd.Shaft(section=[rd.Section(length="800 mm", outer_diameter="20 mm")]),
        rd.BallBearing("A", station="A", designation="6205", clearance="C3"),
        stations={"A": "0 mm"},
    )
    modes: rd.Identified = rd.identify(path, band="10 .. 200 Hz")
    found: rd.Updated = rd.update(rig, modes, ["material.steel.young"], bounds={"material.steel.young": "150 .. 250 GPa"})
    stiffness: npt.NDArray[np.float64] = rig.bearing("A").stiffness(load="0, -500, 0 N")
    print(modes.frequency_hz, stiffness, rd.from_ross(path))
    return found.model
