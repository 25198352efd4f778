"""Campbell diagrams of ROSS itself, `Rotor.run_campbell`, of rotors saved beside this file.

    python make_campbell.py FOLDER          # ROSS 3.1.0 (ross-rotordynamics 3.1.0 of PyPI, Python 3.13)

Writes campbell.json: of each rotor the speeds [rad/s], and for each speed the damped natural frequencies [rad/s] and the log
decrements of the modes that ROSS gives.
"""

import json
import sys
import warnings
from pathlib import Path

import numpy as np
import ross

NAMES = [
    "example_rotor.toml",
    "example_6dof.json",
    "example_with_damping.toml",
    "example_compressor.toml",
    "rotor_assembly_rotor3.json",
    "rotor_assembly_rotor_6dof.toml",
    "examples_rotor_example4.toml",
    "seals_over_speed.toml",
    "supports.toml",
    "unequal_supports.json",
]
SPEEDS = np.linspace(0.0, 700.0, 12)
MODES = 6


def main(folder: Path) -> None:
    warnings.simplefilter("ignore")
    rotors = {}
    for name in NAMES:
        found = ross.Rotor.load(folder / name).run_campbell(SPEEDS, frequencies=MODES)
        rotors[name] = {"speeds": SPEEDS.tolist(), "wd": np.asarray(found.wd).tolist(), "log_dec": np.asarray(found.log_dec).tolist()}
    text = json.dumps({"program": f"ROSS {ross.__version__}", "rotors": rotors})
    (folder / "campbell.json").write_text(text.replace('}, "', '},\n"') + "\n")


main(Path(sys.argv[1]))
