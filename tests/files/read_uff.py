"""Prints as JSON what pyuff reads from the universal files of a folder; `--write` first writes pyuff's own files.

Created tests/data/uff/pyuff.json and pyuff_*.uff:
    ROTORDYN_BLESS=1 cargo test --test files pyuff
    python3 tests/files/read_uff.py tests/data/uff --write > tests/data/uff/pyuff.json
"""

import json
import os
import sys
import warnings

import numpy as np
import pyuff

warnings.simplefilter("ignore")
folder = sys.argv[1]


def parts(values):
    values = np.asarray(values)
    return values.view(float).tolist() if np.iscomplexobj(values) else values.astype(float).tolist()


def shape(dset):
    nodes = dset["node_nums"]
    if "data_at_node" in dset:
        values = np.array(dset["data_at_node"], complex)
    else:
        names = ("r1", "r2", "r3") if "r1" in dset else ("x", "y", "z")
        values = np.array([dset[n] for n in names]).T.astype(complex)
    return {"nodes": np.asarray(nodes, float).tolist(), "values": parts(np.ascontiguousarray(values).ravel())}


def describe(dset):
    kind = int(dset["type"])
    out = {"type": kind}
    if kind == 58:
        out |= {k: dset[k] for k in ("id1", "func_type", "rsp_node", "rsp_dir", "ref_node", "ref_dir", "binary")}
        out |= {k: dset[k] for k in ("ordinate_spec_data_type", "ordinate_axis_units_lab", "z_axis_value")}
        out |= {"x": parts(dset["x"]), "data": parts(dset["data"])}
    elif kind in (55, 2414):
        out |= shape(dset)
    elif kind in (15, 2411):
        out |= {k: np.asarray(dset[k], float).tolist() for k in ("node_nums", "x", "y", "z")}
    elif kind == 82:
        out |= {"id": dset["id"], "nodes": dset["nodes"].tolist()}
    elif kind == 2412:
        out |= {str(k): [e["nodes_nums"] for e in v] for k, v in dset.items() if isinstance(k, int)}
    elif kind == 151:
        out |= {k: dset[k] for k in ("model_name", "program")}
    elif kind == 164:
        out |= {k: dset[k] for k in ("units_code", "length", "force", "temp", "temp_offset")}
    return out


def write(name, binary):
    """Writes the records of example_records.rs in which pyuff's files differ."""
    path = os.path.join(folder, name)
    file = pyuff.UFF(path)
    k = np.arange(17.0)
    pole = lambda k: 1 / (4 - k * k + 0.3j * k)
    j = np.arange(9.0)
    uneven = 1 + 0.5 * j * j
    base = {"type": 58, "binary": binary, "ref_node": 0, "ref_dir": 0, "rsp_node": 0, "rsp_dir": 0}
    base |= {"orddenom_spec_data_type": 0}
    frequency = {"abscissa_spec_data_type": 18}
    sets = [
        {"type": 15, "node_nums": [3, 7, 12, 5], "x": [0, 0, 0.1, 0], "y": [0, -0.05, 1 / 3, 0], "z": [0.12, 0.12, 0.56, 0.625]},
        {"type": 82, "trace_num": 1, "id": "shaft", "nodes": np.array([3, 12, 5, 0, 3, 7])},
        {"type": 55, "analysis_type": 2, "data_ch": 2, "spec_data_type": 8, "load_case": 1, "mode_n": 1}
        | {"freq": 46.25, "modal_m": 2.5, "modal_damp_vis": 0.01, "node_nums": [3, 12, 5]}
        | {"r1": np.array([-0.3, 0.0, 0.3]), "r2": np.array([-0.2, 0.1, 0.4]), "r3": np.array([-0.1, 0.2, 0.5])},
        base | frequency | {"func_type": 4, "id1": "rim/disc_y", "rsp_ent_name": "rim/disc_y", "rsp_node": 12, "rsp_dir": 2}
        | {"ref_node": 12, "ref_dir": -3, "x": 0.125 * k, "data": pole(k), "abscissa_spacing": 1}
        | {"ordinate_spec_data_type": 12, "orddenom_spec_data_type": 13},
        base | frequency | {"func_type": 0, "id1": "lines", "x": uneven, "data": np.exp(j), "ordinate_spec_data_type": 11},
        base | frequency | {"func_type": 0, "id1": "phasors", "x": uneven, "data": 1e3 * pole(j), "ordinate_spec_data_type": 8},
        base | {"func_type": 1, "id1": "A_fy", "rsp_ent_name": "A_fy", "rsp_node": 3, "rsp_dir": -2, "abscissa_spacing": 1}
        | {"abscissa_spec_data_type": 17, "x": 0.25 + np.arange(25) / 12000, "data": 250 - np.arange(25) / 3}
        | {"ordinate_spec_data_type": 13},
    ]
    file.write_sets(sets, "overwrite")


if "--write" in sys.argv:
    write("pyuff_ascii.uff", 0)
    write("pyuff_binary.uff", 1)

found = {}
for name in ("ascii_classic.uff", "ascii_modern.uff", "binary.uff"):
    file = pyuff.UFF(os.path.join(folder, name))
    found[name] = [describe(file.read_sets(k)) for k in range(file.get_n_sets())]
json.dump(found, sys.stdout, indent=1)
