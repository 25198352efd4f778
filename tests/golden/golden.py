#!/usr/bin/env python3
"""Golden outputs: the numbers of results.h5 of every model and variant, to show what a change did not change.

    tests/golden/golden.py run BINARY DIR [--jobs N] [--only PATTERN]
        runs every case with a rotordyn binary; DIR gets one results.h5 a case
    tests/golden/golden.py compare DIR_A DIR_B [--renames FILE] [--tolerance T] [--numbers]
        compares every data set, bit for bit; T permits differences up to T of the data set's largest value, --numbers
        leaves out texts (warnings, labels)
    tests/golden/golden.py store DIR [FILE]
        the compact form: name, type, shape, hash, largest value, rms and some values of every data set
    tests/golden/golden.py check DIR [FILE] [--renames FILE] [--tolerance T]
        compares a run with the compact form

Needs python 3.11, h5py and numpy. Cases: `run` of every file in models/ with every variant, and the commands of EXTRA.
Exit status 1 if anything differs, is missing or is new. Numbers are bit for bit the same only on machines with the same
processor features and C library; elsewhere use --tolerance. --renames: lines `old<TAB>new` of data set or group names in
A (or in the compact form), replaced where they are whole parts of a path.
"""

import argparse
import fnmatch
import gzip
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
STORED = pathlib.Path(__file__).resolve().parent / "golden.json.gz"
SAMPLES = 8
# Commands other than `run`.
EXTRA = {
    "poincare/upadhyay_2009": ["poincare", "models/upadhyay_2009.toml"],
    "lyapunov/varying_compliance": ["lyapunov", "models/varying_compliance.toml"],
    "bifurcation/varying_compliance": [
        "bifurcation", "models/varying_compliance.toml", "--parameter", "bearing.C.radial_clearance",
        "--from", "2 um", "--to", "12 um", "--count", "4",
    ],
    "bearing/zhang_2016": ["bearing", "models/zhang_2016.toml"],
    "frf_noise/overhung_rig": ["frf", "models/overhung_rig.toml", "--noise", "40 dB"],
    "unbalance/overhung_rig": ["unbalance", "models/overhung_rig.toml"],
    "critical/nelson_mcvaugh": ["critical", "models/nelson_mcvaugh.toml"],
}


def cases():
    """Name and arguments of every case."""
    out = {}
    for path in sorted((ROOT / "models").glob("*.toml")):
        variants = tomllib.loads(path.read_text()).get("variant", {})
        model = f"models/{path.name}"
        out[path.stem] = ["run", model]
        for variant in sorted(variants):
            out[f"{path.stem}@{variant}"] = ["run", model, "--variant", variant]
    return out | EXTRA


def run_case(binary, folder, name, arguments):
    out = folder / name.replace("/", "+")
    out.mkdir(parents=True, exist_ok=True)
    command = [binary, *arguments, "--out", str(out), "--no-figures", "--quiet", "--threads", "1"]
    environment = os.environ | {"XDG_CACHE_HOME": str(folder / "cache")}
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, env=environment)
    (out / "messages.txt").write_text(f"exit {done.returncode}\n{done.stdout}{done.stderr}")
    return name, done.returncode


def data_sets(file):
    """Every data set of a results file by its path; strings as text."""
    out = {}

    def visit(path, item):
        if isinstance(item, h5py.Dataset):
            out[path] = item.asstr()[()] if h5py.check_string_dtype(item.dtype) else item[()]

    with h5py.File(file) as h5:
        h5.visititems(visit)
    return {path: np.asarray(value) for path, value in out.items()}


def numbers(values):
    """Values as a flat array of reals; texts as none."""
    if values.dtype.names:
        return np.concatenate([numbers(values[name]) for name in values.dtype.names] or [np.empty(0)])
    if values.dtype.kind == "c":
        return np.stack([values.real, values.imag], -1).ravel()
    return values.astype(float).ravel() if values.dtype.kind in "fiub" else np.empty(0)


def raw(values):
    if values.dtype.kind in "OUST":
        return "\0".join(map(str, values.ravel().tolist())).encode()
    return np.ascontiguousarray(values).tobytes()


def compact(values):
    real = numbers(values)
    finite = real[np.isfinite(real)]
    picks = np.unique(np.linspace(0, len(real) - 1, SAMPLES).round().astype(int)) if len(real) else []
    return {
        "type": str(values.dtype),
        "shape": list(values.shape),
        "hash": hashlib.sha256(raw(values)).hexdigest()[:16],
        "largest": float(np.abs(finite).max(initial=0.0)),
        "rms": float(np.sqrt(np.mean(finite**2))) if len(finite) else 0.0,
        "values": [float(real[k]) if np.isfinite(real[k]) else None for k in picks],
    }


def renamed(path, renames):
    """A path with whole parts renamed; an entry may span several parts."""
    text = f"/{path}/"
    for old, new in renames:
        text = text.replace(f"/{old}/", f"/{new}/")
    return text.strip("/")


def read_renames(file):
    if file is None:
        return []
    lines = (line.split("\t") for line in pathlib.Path(file).read_text().splitlines() if "\t" in line)
    return [(old, new) for old, new in lines]


def report(rows, compared):
    for row in rows:
        print(row)
    print(f"{compared} data sets compared, {len(rows)} differ")
    return 1 if rows or not compared else 0


def names_apart(case, old, new):
    for name in sorted(old - new):
        yield f"{case}: {name} is missing"
    for name in sorted(new - old):
        yield f"{case}: {name} is new"


def difference(a, b):
    """Largest difference of two arrays over the largest value of the first; infinite where one alone is not finite."""
    a, b = numbers(a), numbers(b)
    if len(a) != len(b):
        return np.inf
    finite = np.isfinite(a)
    if not np.array_equal(finite, np.isfinite(b)):
        return np.inf
    scale = np.abs(a[finite]).max(initial=0.0)
    apart = np.abs(a - b)[finite].max(initial=0.0)
    return 0.0 if apart == 0.0 else apart / scale if scale else np.inf


def results_of(folder):
    folder = pathlib.Path(folder)
    files = sorted(p for p in folder.glob("*/*.h5"))
    return {str(p.relative_to(folder)): p for p in files}


def compare(first, second, renames, tolerance, numbers_only):
    a, b = results_of(first), results_of(second)
    rows, compared = list(names_apart("runs", set(a), set(b))), 0
    for case in sorted(set(a) & set(b)):
        old = {renamed(path, renames): v for path, v in data_sets(a[case]).items()}
        new = data_sets(b[case])
        rows += names_apart(case, set(old), set(new))
        for path in sorted(set(old) & set(new)):
            compared += 1
            x, y = old[path], new[path]
            if x.shape == y.shape and raw(x) == raw(y):
                continue
            if x.shape != y.shape:
                rows.append(f"{case}: {path} has shape {y.shape}, had {x.shape}")
            elif len(numbers(x)) == 0:
                if not numbers_only:
                    rows.append(f"{case}: {path} is {y.ravel()[:3]}, was {x.ravel()[:3]}")
            elif not (apart := difference(x, y)) <= tolerance:
                rows.append(f"{case}: {path} differs by {apart:.2g} of its largest value")
    return report(rows, compared)


def store(folder, file):
    stored = {
        case: {path: compact(v) for path, v in sorted(data_sets(p).items())}
        for case, p in results_of(folder).items()
    }
    with gzip.GzipFile(file, "wb", mtime=0) as out:
        out.write(json.dumps(stored, separators=(",", ":")).encode())
    print(f"{sum(map(len, stored.values()))} data sets of {len(stored)} runs in {file}")


def check(folder, file, renames, tolerance):
    stored = json.loads(gzip.open(file).read())
    found = results_of(folder)
    rows, compared = list(names_apart("runs", set(stored), set(found))), 0
    for case in sorted(set(stored) & set(found)):
        old = {renamed(path, renames): v for path, v in stored[case].items()}
        new = {path: compact(v) for path, v in data_sets(found[case]).items()}
        rows += names_apart(case, set(old), set(new))
        for path in sorted(set(old) & set(new)):
            compared += 1
            x, y = old[path], new[path]
            if x["hash"] == y["hash"] and x["shape"] == y["shape"]:
                continue
            if x["shape"] != y["shape"]:
                rows.append(f"{case}: {path} has shape {y['shape']}, had {x['shape']}")
                continue
            pick = lambda one: np.array([np.nan if v is None else v for v in one["values"]])
            scale = x["largest"] or 1.0
            apart = max(difference(pick(x), pick(y)) if len(pick(x)) else 0.0, abs(x["rms"] - y["rms"]) / scale)
            if not tolerance or not apart <= tolerance:
                rows.append(f"{case}: {path} differs by {apart:.2g} (of {SAMPLES} values and the rms)")
    return report(rows, compared)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser("run")
    one.add_argument("binary")
    one.add_argument("folder")
    one.add_argument("--jobs", type=int, default=2)
    one.add_argument("--only", default="*")
    two = commands.add_parser("compare")
    two.add_argument("a")
    two.add_argument("b")
    two.add_argument("--numbers", action="store_true")
    three = commands.add_parser("store")
    three.add_argument("folder")
    three.add_argument("file", nargs="?", default=STORED)
    four = commands.add_parser("check")
    four.add_argument("folder")
    four.add_argument("file", nargs="?", default=STORED)
    for each in (two, four):
        each.add_argument("--renames")
        each.add_argument("--tolerance", type=float, default=0.0)
    options = parser.parse_args()

    if options.command == "run":
        folder = pathlib.Path(options.folder).resolve()
        binary = str(pathlib.Path(options.binary).resolve())
        wanted = {n: a for n, a in cases().items() if fnmatch.fnmatch(n, options.only)}
        with ThreadPoolExecutor(options.jobs) as pool:
            for name, code in pool.map(lambda case: run_case(binary, folder, *case), wanted.items()):
                print(f"{name}: exit {code}", flush=True)
        return 0
    if options.command == "compare":
        return compare(options.a, options.b, read_renames(options.renames), options.tolerance, options.numbers)
    if options.command == "store":
        return store(options.folder, options.file)
    return check(options.folder, options.file, read_renames(options.renames), options.tolerance)


if __name__ == "__main__":
    sys.exit(main())
