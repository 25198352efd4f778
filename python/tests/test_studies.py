"""Linear studies: the same bits as the command, and what the arrays mean."""

from __future__ import annotations

import inspect
import pickle
import warnings
from pathlib import Path

import numpy as np
import pytest

import rotordyn as rd
from conftest import MODELS, command, load

MACHINES = [path.name for path in sorted(MODELS.glob("*.toml")) if path.name != "cwru_6205.toml"]
STUDIES = ["static", "modal", "campbell", "critical", "critical-map", "torsional", "frf", "unbalance"]
#: What is of the command: times, files, and the identity of the results file.
OF_COMMAND = {"command", "seconds", "wall_seconds", "cpu_seconds", "files", "identity", "exit_code", "errors", "checkpoints"}


@pytest.mark.parametrize("study", STUDIES)
@pytest.mark.parametrize("name", MACHINES)
def test_bits_of_the_command(name: str, study: str, tmp_path: Path) -> None:
    expected = command(study, str(MODELS / name), "--out", str(tmp_path), "--no-figures")
    model = load(name)
    if expected["exit_code"] != 0:
        with pytest.raises(rd.Error):
            getattr(model, study.replace("-", "_"))()
        return
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = getattr(model, study.replace("-", "_"))().to_dict()
    for key in OF_COMMAND:
        expected.pop(key, None)
    assert found == expected


def test_bits_of_the_command_with_flags(tmp_path: Path) -> None:
    path = str(MODELS / "overhung_rig.toml")
    words = ["--variant", "wavy", "--set", "bearing.B.radial_clearance=20 um", "--speed", "0, 700 rpm", "--modes", "5"]
    expected = command("modal", path, "--out", str(tmp_path), "--no-figures", *words)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        rig = load("overhung_rig.toml").variant("wavy")
        rig["bearing.B.radial_clearance"] = "20 um"
        found = rig.modal(speed=["0 rpm", "700 rpm"], modes=5).to_dict()
    assert found["modal"] == expected["modal"] and found["warnings"] == expected["warnings"]


def test_modes(jeffcott: rd.Model) -> None:
    modes = jeffcott.modal(speed="1200 rpm", modes=6)
    assert modes.speed_rpm == pytest.approx(1200.0) and len(modes) == 1
    assert modes.frequency_hz.shape == (6,) and modes.unit("frequency_hz") == "Hz"
    assert modes.shapes.shape == (6, len(modes.nodes), 6) and modes.shapes.dtype == complex
    assert np.allclose(modes.omega, 2 * np.pi * modes.frequency_hz, rtol=1e-14)
    # lambda = -zeta |lambda| +- j omega
    assert np.allclose(modes.zeta, -modes.eigenvalue.real / abs(modes.eigenvalue), rtol=1e-12)
    assert np.allclose(abs(modes.eigenvalue.imag), modes.omega, rtol=1e-12)
    bending = [k for k, label in enumerate(modes.label) if "bending" in label][:2]
    backward, forward = (modes.whirl[k, len(modes.nodes) // 2] for k in bending)
    assert backward < 0.0 < forward
    several = jeffcott.modal(speed=["0 rpm", "1200 rpm"], modes=6)
    assert several.frequency_hz.shape == (2, 6) and len(several[1]) == 6
    assert np.array_equal(several.frequency_hz[1], modes.frequency_hz)
    assert "frequency_hz" in dir(modes) and "frequency_hz" in modes.keys() and "Hz" in repr(modes)
    with pytest.raises(AttributeError, match="frequency_hz"):
        modes.frequency_h


def test_matrices_have_the_eigenvalues_of_the_modes(jeffcott: rd.Model) -> None:
    found = jeffcott.matrices(speed="1200 rpm")
    M, C, G, K = found
    n = len(found.dofs)
    assert M.shape == C.shape == G.shape == K.shape == (n, n) and len(jeffcott.dofs) == n
    assert "disc u_x" in " ".join(found.dofs) or any(label.endswith("u_x") for label in found.dofs)
    # Element by element the sums of the assembly round differently.
    assert np.allclose(M, M.T, rtol=1e-12, atol=1e-15 * abs(M).max()) and np.linalg.eigvalsh(M).min() > 0.0
    assert np.allclose(G, -G.T, rtol=1e-12, atol=1e-15 * abs(G).max()) and abs(G).max() > 0.0
    omega = found.speed_rpm * np.pi / 30.0
    D = C + omega * G
    A = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(M, K), -np.linalg.solve(M, D)]])
    values = np.linalg.eigvals(A)
    modes = jeffcott.modal(speed="1200 rpm", modes=6)
    for value in modes.eigenvalue:
        # The spread of LAPACK's eigenvalues of a matrix with norms up to 1e9.
        assert np.min(abs(values - value)) < 1e-6 * abs(value)


def test_campbell(jeffcott: rd.Model) -> None:
    found = jeffcott.campbell(max_speed="6000 rpm")
    assert found.speeds_rpm[-1] == pytest.approx(6000.0)
    assert found.frequency_hz.shape == (len(found.branches), len(found.speeds_rpm))
    figure = found.plot()
    assert figure.svg.startswith("<svg") and figure._repr_svg_() == figure.svg and figure.svg in figure._repr_html_()
    assert found.figures and found._repr_html_() == figure.svg
    # At a crossing of order 1 the frequency is the speed.
    crossings = found.crossings
    first = next(row for row in crossings if row["order"] == 1.0)
    assert first["frequency_hz"] == pytest.approx(first["order"] * first["speed_rpm"] / 60.0, rel=1e-6)
    critical = jeffcott.critical(max_speed="6000 rpm")
    assert critical.speed_rpm[0] == pytest.approx(first["speed_rpm"], rel=1e-6)


def test_frf(jeffcott: rd.Model) -> None:
    found = jeffcott.frf(max_frequency="100 Hz")
    response, excitation = found.responses[0], found.excitations[0]
    direct = found[response, excitation]
    assert direct.shape == found.frequency_hz.shape and direct.dtype == complex
    assert np.array_equal(direct, found.response[0, 0])
    mobility = jeffcott.frf(max_frequency="100 Hz", quantity="mobility")
    # Frequencies are added at the peaks, which differ.
    at, other = found.requested, mobility.requested
    expected = 2j * np.pi * found.frequency_hz[at] * direct[at]
    assert np.allclose(mobility[mobility.responses[0], excitation][other], expected, rtol=1e-10)
    with pytest.raises(rd.InputError):
        found["nothing", excitation]
    with pytest.raises(rd.InputError):
        found["a", "b", "c"]


def test_static_and_bearing(rig: rd.Model) -> None:
    found = rig.static()
    force = sum(rig.bearing(name).force() for name in ("A", "B"))
    assert force.shape == (6,) and force[1] > 0.0
    stiffness = rig.bearing("B").stiffness(speed="900 rpm")
    assert stiffness.shape == (6, 6) and stiffness[1, 1] > 1e6
    assert rig.bearing("B").damping().shape == (6, 6)
    assert "bearings" in found.keys() and "rig" in repr(rig.bearing("B"))


def test_torsional_unbalance_and_map(jeffcott: rd.Model) -> None:
    assert len(jeffcott.torsional(modes=3).modes) == 3
    unbalance = jeffcott.unbalance(max_speed="3000 rpm")
    assert unbalance.speeds_rpm[-1] == pytest.approx(3000.0) and len(unbalance.responses) > 0
    first = unbalance[unbalance.responses[0]["name"]]
    assert first.dtype == complex and first.shape == unbalance.speeds_rpm.shape
    assert len(jeffcott.critical_map(max_speed="6000 rpm").curves) > 0


def test_results_are_pickled(rig: rd.Model) -> None:
    for found in (rig.modal(), rig.campbell(), rig.frf(), rig.static()):
        again = pickle.loads(pickle.dumps(found))
        assert type(again) is type(found) and again.to_json() == found.to_json()
        assert [str(w) for w in again.warnings] == [str(w) for w in found.warnings]


def test_saved_file_is_that_of_the_command(jeffcott: rd.Model, tmp_path: Path) -> None:
    h5py = pytest.importorskip("h5py")
    command("modal", str(MODELS / "jeffcott.toml"), "--out", str(tmp_path), "--no-figures")
    jeffcott.modal().save(tmp_path / "own.h5")
    with h5py.File(tmp_path / "results.h5") as expected, h5py.File(tmp_path / "own.h5") as found:
        names: list[str] = []
        expected.visit(names.append)
        own: list[str] = []
        found.visit(own.append)
        assert sorted(own) == sorted(names)
        for name in names:
            if isinstance(expected[name], h5py.Dataset):
                assert np.array_equal(expected[name][()], found[name][()]), name


def test_pandas_and_xarray(jeffcott: rd.Model) -> None:
    pytest.importorskip("pandas")
    pytest.importorskip("xarray")
    frame = jeffcott.modal(speed=["0 rpm", "1200 rpm"], modes=4).to_pandas()
    assert len(frame) == 8 and set(frame["speed_rpm"].round()) == {0.0, 1200.0}
    dataset = jeffcott.modal(speed="1200 rpm", modes=4).to_xarray()
    assert dataset["frequency_hz"].dims == ("speed_rpm", "mode") and dataset["shape"].sizes["dof"] == 6
    campbell = jeffcott.campbell(max_speed="3000 rpm")
    assert campbell.to_pandas().shape == campbell.frequency_hz.T.shape
    assert campbell.to_xarray()["frequency_hz"].attrs["units"] == "Hz"
    frf = jeffcott.frf(max_frequency="50 Hz")
    assert frf.to_pandas().shape[0] == len(frf.frequency_hz) and "frequency_hz" in frf.to_xarray().coords
    assert len(jeffcott.critical().to_pandas()) == len(jeffcott.critical().speeds)
    assert jeffcott.unbalance().to_pandas().shape[0] > 0 and jeffcott.unbalance().to_xarray() is not None


def test_plotly(jeffcott: rd.Model) -> None:
    pytest.importorskip("plotly")
    campbell = jeffcott.campbell(max_speed="3000 rpm")
    lines = len(campbell.branches) + len(campbell.orders)
    assert len(campbell.plot(backend="plotly").data) == lines
    assert len(jeffcott.frf().plot(backend="plotly").data) > 0
    assert len(jeffcott.unbalance().plot(backend="plotly").data) == len(jeffcott.unbalance().responses)
    with pytest.raises(rd.InputError, match="SVG"):
        jeffcott.modal().plot(backend="plotly")


def test_figures_are_saved(jeffcott: rd.Model, tmp_path: Path) -> None:
    figure = jeffcott.campbell().plot()
    figure.save(tmp_path / "campbell.svg")
    assert (tmp_path / "campbell.svg").read_text(encoding="utf-8") == figure.svg and "SVG" in repr(figure)
    with pytest.raises(rd.InputError, match="svg"):
        figure.save(tmp_path / "campbell.pdf")


def test_map_on_all_cores(jeffcott: rd.Model) -> None:
    from concurrent.futures import ProcessPoolExecutor

    thicknesses = ["20 mm", "30 mm", "40 mm"]
    changes = [{"disc.main.thickness": text} for text in thicknesses]
    found = rd.map(changes, "modal", base=jeffcott, speed="0 rpm", modes=2)
    first = [modes.frequency_hz[0] for modes in found]
    assert first == sorted(first, reverse=True) and len(set(first)) == 3
    one = jeffcott.with_changes(changes[1]).modal(speed="0 rpm", modes=2)
    assert found[1].to_json() == one.to_json()
    assert rd.map([jeffcott], lambda model: model.name) == ["jeffcott"]
    import multiprocessing

    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(2, mp_context=context) as executor:
        again = rd.map(changes, "modal", base=jeffcott, executor=executor, speed="0 rpm", modes=2)
    assert [modes.to_json() for modes in again] == [modes.to_json() for modes in found]
    for wrong in (lambda: rd.map([{}], "modal"), lambda: rd.map([3], "modal", base=jeffcott),  # type: ignore[list-item]
                  lambda: rd.map([jeffcott], "nothing"), lambda: rd.map([jeffcott], lambda m: m, speed="0 rpm")):
        with pytest.raises(rd.InputError):
            wrong()


def test_threads() -> None:
    for wrong in (0, -1, 1.5, True, "two"):
        with pytest.raises(rd.InputError):
            rd.set_threads(wrong)  # type: ignore[arg-type]


def test_every_public_name_has_a_docstring() -> None:
    for name in rd.__all__:
        found = getattr(rd, name)
        assert inspect.getdoc(found), name
        if inspect.isclass(found):
            for member, value in vars(found).items():
                if not member.startswith("_") and (inspect.isfunction(value) or isinstance(value, property)):
                    assert inspect.getdoc(value), f"{name}.{member}"
