"""One case of `beside_ross.py` in ROSS: builds the rotor of tests/data/ross/bench_model_40.json and runs an analysis."""

import json
import sys
from pathlib import Path

import numpy as np
import ross as rs

FIGURES = Path(__file__).resolve().parents[2] / "tests" / "data" / "ross" / "bench_model_40.json"


def rotor():
    data = json.loads(FIGURES.read_text())
    steel = data["materials"]["steel"]
    material = rs.Material(name="steel", rho=steel["rho"], E=steel["E"], G_s=steel["G"])
    shaft = [
        rs.ShaftElement(
            L=element["L"],
            idl=element["idl"],
            odl=element["odl"],
            material=material,
            n=element["n"],
            shear_effects=True,
            rotary_inertia=True,
            gyroscopic=True,
        )
        for element in data["shaft_elements"]
    ]
    discs = [rs.DiskElement(n=disc["n"], m=disc["m"], Id=disc["Id"], Ip=disc["Ip"]) for disc in data["discs"]]
    bearings = [
        rs.BearingElement(n=b["n"], kxx=b["kxx"], kyy=b["kyy"], cxx=b["cxx"], cyy=b["cyy"]) for b in data["bearings"]
    ]
    return rs.Rotor(shaft, discs, bearings)


def newmark(rotor):
    speed, steps = 400.0, 10_000
    t = np.linspace(0.0, 1.0, steps + 1)
    force = np.zeros((steps + 1, rotor.ndof))
    row = rotor.number_dof * 13
    force[:, row] = 1e-3 * speed**2 * np.cos(speed * t)
    force[:, row + 1] = 1e-3 * speed**2 * np.sin(speed * t)
    rotor.run_time_response(speed, force, t, method="newmark", model_reduction={"num_modes": 12})


CASES = {
    "start": lambda rotor: None,
    "modal": lambda rotor: rotor.run_modal(400.0, num_modes=12),
    "campbell": lambda rotor: rotor.run_campbell(np.linspace(0.0, 975.0, 40), frequencies=6),
    "critical": lambda rotor: rotor.run_critical_speed(num_modes=12),
    "unbalance": lambda rotor: rotor.run_unbalance_response([13], [1e-3], [0.0], np.linspace(1.0, 1000.0, 1000)),
    "frf": lambda rotor: rotor.run_freq_response(speed_range=np.linspace(2.0, 1885.0, 1000)),
    "newmark": newmark,
}

if __name__ == "__main__":
    CASES[sys.argv[1]](rotor())
