"""Files as people have them: structures, nested structures, cells and arrays of structures.

Written to the folder given; tests/files/matlab_structures.rs has the expected contents. Made with scipy 1.17.1.
"""

import os
import sys

import numpy
import scipy.io

folder = sys.argv[1]
count = numpy.arange(100.0)
path = lambda name: os.path.join(folder, name)

# As the bearing records of the MFPT society.
bearing = {"sr": 97656, "gs": numpy.sin(0.3 * count).reshape(-1, 1), "load": 270, "rate": 25}
scipy.io.savemat(path("mfpt.mat"), {"bearing": bearing}, do_compression=True)

runs = numpy.zeros((2,), dtype=[("x", object), ("fs", object), ("note", object)])
runs[0] = (count, 1000.0, "first")
runs[1] = (2 * count, 2000.0, "second")
cells = numpy.empty((3,), dtype=object)
cells[0], cells[1], cells[2] = count, "text", 5 * count
nested = {
    "Fs": 512.0,
    "rig": {
        "sensor": {"acc": {"data": count + 1, "unit": "g"}, "dt": 0.25, "temperature": 21.5},
        "slow": {"t": 0.5 * count, "level": 3 * count, "phase": -count},
    },
    "outside": 7 * count,
    "runs": runs,
    "cells": cells,
    "sparse": scipy.sparse.eye(4),
}
scipy.io.savemat(path("nested.mat"), nested)

frf = {"Freq_domain": 0.5 * count, "H": count * (1 + 2j), "coh": 0.01 * count}
scipy.io.savemat(path("frf.mat"), {"test": frf})

scipy.io.savemat(
    path("version_4.mat"),
    {"SampleFrequency": 800.0, "x": count, "y": numpy.array([count, -count]).astype("int16"), "z": count * 1j, "name": "a text"},
    format="4",
)
