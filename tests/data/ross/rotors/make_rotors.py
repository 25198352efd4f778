"""Saves the example rotors of ROSS and those of its tests, and computes reference figures of each saved file.

    python make_rotors.py FOLDER            with ROSS 3.1.0 (`pip install ross-rotordynamics==3.1.0`)
    python make_rotors.py FOLDER v2_        with ROSS 2.3.0: a few of them, names with this prefix

 Every rotor is saved with `Rotor.save`, loaded again with
`Rotor.load`, and the figures are those of the loaded rotor: what a file does not hold (damping of the whole rotor, modal
damping) is in neither. The figures are solved with the matrices of ROSS itself: eigenvalues by a dense shift-inverted
solution, responses by `run_unbalance_response` and, with ROSS 3, `run_freq_response`. Rotors with the figures of one before
are left out.
"""

import inspect
import json
import sys
import types
import warnings
from pathlib import Path

import numpy as np
import ross
from scipy import linalg

MAJOR = int(ross.__version__.split(".")[0])
SPEEDS = [0.0, 120.0, 350.0, 700.0]
RESPONSE_SPEEDS = [20.0, 65.0, 110.0, 250.0, 420.0, 700.0]
FRF_SPEED = 200.0
FREQUENCIES = [15.0, 55.0, 130.0, 310.0, 600.0]
MODES = 10
SHIFT = 30.0
UNBALANCE = {"magnitude": 1e-3, "phase": 0.3}


def fixtures(module):
    """Functions without arguments of a test module that give a rotor, the marks of pytest taken off."""
    path = Path(ross.__file__).parent / "tests" / f"{module}.py"
    text = path.read_text().replace("@pytest.fixture", "")
    stub = types.ModuleType("pytest")

    def ignored(*args, **kwargs):
        return lambda function: function

    stub.mark = types.SimpleNamespace(parametrize=ignored, skip=ignored, skipif=ignored, filterwarnings=ignored, slow=ignored)
    stub.approx = stub.raises = stub.warns = ignored
    kept = sys.modules.get("pytest")
    sys.modules["pytest"] = stub
    space = {"__name__": module, "__file__": str(path)}
    try:
        exec(compile(text, str(path), "exec"), space)
    finally:
        if kept is None:
            del sys.modules["pytest"]
        else:
            sys.modules["pytest"] = kept
    for name, function in space.items():
        if inspect.isfunction(function) and name.startswith("rotor") and function.__module__ == module:
            arguments = inspect.signature(function).parameters.values()
            if all(a.default is not a.empty for a in arguments):
                yield name, function


def candidates():
    for name in ("rotor_example", "rotor_example_6dof", "rotor_example_with_damping", "compressor_example"):
        yield f"example_{name.replace('_example', '').replace('rotor_', '')}", getattr(ross.rotor_assembly, name)
    for module in (
        "test_rotor_assembly", "test_6dof_model", "test_examples", "test_transient_newmark", "test_crack", "test_rubbing",
        "test_misalignment", "test_mesh_convergence", "test_results", "test_plot_results",
    ):
        try:
            for name, function in fixtures(module):
                yield f"{module.removeprefix('test_')}_{name}", function
        except Exception as error:
            print(f"{module}: {error!r}")
    yield "supports", supports
    yield "unequal_supports", unequal_supports
    yield "cone_hollow", cone_hollow
    yield "hutchinson", hutchinson
    yield "forces", forces
    yield "seals_over_speed", seals_over_speed
    yield "coupling", coupling
    yield "over_whirl_frequency", over_whirl_frequency
    if hasattr(ross.rotor_assembly, "coaxrotor_example"):
        yield "coaxial", ross.rotor_assembly.coaxrotor_example


def steel():
    return ross.Material(name="Steel", rho=7810, E=211e9, G_s=81.2e9)


def shaft(count=6, **options):
    return [ross.ShaftElement(0.25, 0, 0.05, material=steel(), **options) for _ in range(count)]


def discs():
    return [ross.DiskElement.from_geometry(n, steel(), 0.07, 0.05, 0.28) for n in (2, 4)]


def supports():
    """The rotor of test_distinct_dof_elements_error's neighbour: bearings on point masses on springs."""
    bearings = [
        ross.BearingElement(0, n_link=7, kxx=1e6, kyy=0.8e6, cxx=0),
        ross.BearingElement(6, n_link=8, kxx=1e6, kyy=0.8e6, cxx=0),
        ross.BearingElement(7, kxx=1e6, kyy=0.8e6, cxx=0, tag="Support0"),
        ross.BearingElement(8, kxx=1e6, kyy=0.8e6, cxx=0, tag="Support1"),
    ]
    return ross.Rotor(shaft(), discs(), bearings, [ross.PointMass(7, m=1.0), ross.PointMass(8, m=1.0)])


def unequal_supports():
    bearings = [
        ross.BearingElement(0, n_link=7, kxx=2e7, kyy=1e7, kxy=1e6, kyx=-2e6, kzz=5e5, cxx=900, cyy=700, czz=10),
        ross.BearingElement(6, n_link=8, kxx=2e7, kyy=1e7, kzz=3e5, cxx=900, cyy=700),
        ross.BearingElement(7, kxx=5e7, kyy=4e7, kzz=8e6, cxx=400, cyy=300, czz=50, tag="Support0"),
        ross.BearingElement(8, kxx=6e7, kyy=5e7, kzz=9e6, cxx=400, cyy=300, czz=50, tag="Support1"),
    ]
    masses = [ross.PointMass(7, mx=12.0, my=18.0, mz=25.0), ross.PointMass(8, mx=10.0, my=15.0, mz=20.0)]
    return ross.Rotor(shaft(), discs(), bearings, masses)


def cone_hollow():
    elements = [
        ross.ShaftElement(0.2, 0.01, 0.05, 0.01, 0.05, material=steel()),
        ross.ShaftElement(0.15, 0.01, 0.05, 0.02, 0.09, material=steel()),
        ross.ShaftElement(0.15, 0.02, 0.09, 0.03, 0.12, material=steel()),
        ross.ShaftElement(0.3, 0.03, 0.12, 0.03, 0.12, material=steel()),
        ross.ShaftElement(0.2, 0.03, 0.12, 0.0, 0.05, material=steel()),
    ]
    bearings = [
        ross.BearingElement(0, kxx=5e7, kyy=4e7, kzz=1e7, cxx=800, czz=100),
        ross.BearingElement(5, kxx=5e7, kyy=4e7, kzz=1e7, cxx=800, czz=100),
    ]
    return ross.Rotor(elements, [ross.DiskElement(3, m=20, Id=0.2, Ip=0.35)], bearings)


def hutchinson():
    bearings = [ross.BearingElement(n, kxx=1e7, kyy=0.8e7, cxx=500) for n in (0, 6)]
    return ross.Rotor(shaft(shear_method_calc="hutchinson"), discs(), bearings)


def forces():
    options = {"axial_force": 2e4, "torque": 3e3, "alpha": 2.0, "beta": 1e-5}
    bearings = [ross.BearingElement(n, kxx=1e7, kyy=0.8e7, kzz=1e6, cxx=500, cyy=400) for n in (0, 6)]
    return ross.Rotor(shaft(**options), discs(), bearings)


def seals_over_speed():
    speed = [0.0, 150.0, 300.0, 500.0, 900.0]
    table = dict(speed=speed, kxx=[1e6, 1.1e6, 1.3e6, 1.6e6, 2e6], kyy=[0.9e6, 1e6, 1.2e6, 1.5e6, 1.9e6],
                 kxy=[0, 1e5, 2e5, 3e5, 5e5], kyx=[0, -1e5, -2e5, -3e5, -5e5], cxx=[900, 850, 800, 700, 600])
    seal = {key: value if key == "speed" else [0.3 * v for v in value] for key, value in table.items()}
    bearings = [ross.BearingElement(0, **table), ross.BearingElement(6, **table), ross.SealElement(3, **seal)]
    return ross.Rotor(shaft(), discs(), bearings)


def coupling():
    elements = shaft(3) + [
        ross.CouplingElement(m_l=3, m_r=4, Ip_l=0.02, Ip_r=0.03, kt_x=5e8, kt_y=4e8, kt_z=2e8, kr_x=3e5, kr_y=2e5,
                             kr_z=1e6, ct_x=50, cr_x=1, cr_z=2, o_d=0.1, L=0.1)
    ] + shaft(3)
    bearings = [ross.BearingElement(n, kxx=1e7, kyy=0.8e7, kzz=1e6, cxx=500) for n in (0, 3, 4, 7)]
    return ross.Rotor(elements, [ross.DiskElement(5, m=10, Id=0.1, Ip=0.15)], bearings)


def matrices(rotor, frequency, speed):
    """M, K and C + speed G; ROSS 2 takes coefficients at one frequency only."""
    at = (frequency, speed) if MAJOR >= 3 else (frequency,)
    return rotor.M(*at), rotor.K(*at), rotor.C(*at) + speed * rotor.G()


def over_whirl_frequency():
    """Bearings over whirl frequency alone, a seal over speed and whirl frequency."""
    whirl, speed = [0.0, 100.0, 250.0, 450.0, 800.0], [0.0, 200.0, 400.0, 800.0]
    table = dict(frequency=whirl, kxx=[5e6, 5.5e6, 6e6, 7e6, 8e6], cxx=[900, 800, 700, 650, 600])
    grid = dict(
        speed=speed, frequency=whirl,
        kxx=[[1e6 + 1e3 * w + 500 * f for f in whirl] for w in speed],
        kxy=[[2e3 * w + 300 * f for f in whirl] for w in speed],
        kyx=[[-2e3 * w - 300 * f for f in whirl] for w in speed],
        cxx=[[500 + 0.2 * w + 0.1 * f + 1e-4 * f * f for f in whirl] for w in speed],
    )
    bearings = [ross.BearingElement(0, **table), ross.BearingElement(6, **table), ross.SealElement(3, **grid)]
    return ross.Rotor(shaft(), discs(), bearings)


def eigenvalues(rotor, speed):
    """Oscillatory eigenvalues of least magnitude, sorted, by dense shift and inversion."""
    m, k, c = matrices(rotor, speed, speed)
    n = len(m)
    a = np.block([[np.zeros((n, n)), np.eye(n)], [-k, -c]])
    b = np.block([[np.eye(n), np.zeros((n, n))], [np.zeros((n, n)), m]])
    mu = linalg.eigvals(linalg.solve(a - SHIFT * b, b))
    mu = mu[np.abs(mu) > 1e-9 * np.abs(mu).max()]
    values = SHIFT + 1 / mu
    values = values[(values.imag > 1.0) & (np.abs(values) > 1.0)]
    return sorted(values, key=abs)[:MODES]


def parts(values):
    values = np.asarray(values)
    return {"re": values.real.tolist(), "im": values.imag.tolist()}


def figures(rotor):
    node = rotor.disk_elements[0].n if rotor.disk_elements else rotor.nodes[len(rotor.nodes) // 2]
    probes = sorted({int(node), int(rotor.nodes[-1]) if rotor.nodes[-1] <= rotor.shaft_elements[-1].n + 1 else 0})
    out = {"eigenvalues": [], "unbalance": {"node": int(node), **UNBALANCE, "speeds": RESPONSE_SPEEDS, "probes": []}}
    for speed in SPEEDS:
        out["eigenvalues"].append({"speed": speed, **parts(eigenvalues(rotor, speed))})
    range_name = "speed_range" if MAJOR >= 3 else "frequency"
    response = rotor.run_unbalance_response(
        node=[int(node)], unbalance_magnitude=[UNBALANCE["magnitude"]], unbalance_phase=[UNBALANCE["phase"]],
        **{range_name: np.array(RESPONSE_SPEEDS)},
    ).forced_resp
    for probe in probes:
        at = rotor.number_dof * probe
        out["unbalance"]["probes"].append({"node": probe, "x": parts(response[at]), "y": parts(response[at + 1])})
    if MAJOR >= 3:
        frf = rotor.run_freq_response(speed_range=np.array(FREQUENCIES), speed=FRF_SPEED).freq_resp
    else:
        solved = []
        for w in FREQUENCIES:
            m, k, c = matrices(rotor, FRF_SPEED, FRF_SPEED)
            solved.append(linalg.inv(k - w**2 * m + 1j * w * c))
        frf = np.moveaxis(solved, 0, -1)
    at = rotor.number_dof * int(node)
    out["frf"] = {"speed": FRF_SPEED, "frequencies": FREQUENCIES, "node": int(node),
                  "xx": parts(frf[at, at]), "yx": parts(frf[at + 1, at]), "yy": parts(frf[at + 1, at + 1])}
    return out


def main(folder, prefix):
    folder.mkdir(parents=True, exist_ok=True)
    found = {}
    for number, (name, make) in enumerate(candidates()):
        if prefix and name not in ("example_rotor", "supports", "unequal_supports", "cone_hollow", "hutchinson", "coupling", "coaxial"):
            continue
        name = prefix + name
        try:
            rotor = make()
            file = folder / f"{name}.{'json' if number % 3 == 1 else 'toml'}"
            file.unlink(missing_ok=True)
            rotor.save(file)
            if type(rotor) is not ross.Rotor:
                print(f"{file.name}: {type(rotor).__name__}, without figures")
                continue
            rotor = ross.Rotor.load(file)
            own = figures(rotor)
            same = [other for other, known in found.items() if known == own]
            if same:
                file.unlink()
                print(f"{name}: as {same[0]}")
                continue
            found[file.name] = own
            print(f"{file.name}: {len(rotor.nodes)} nodes")
        except Exception as error:
            print(f"{name}: {error!r}"[:300])
    text = json.dumps({"ross_version": ross.__version__, "rotors": found}, indent=0, separators=(",", ":"))
    (folder / f"{prefix}figures.json").write_text(text + "\n")


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    main(Path(sys.argv[1]), "".join(sys.argv[2:]))
