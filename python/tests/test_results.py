"""Results: tables, fields, modes, matrices, figures."""

from __future__ import annotations

import gc
from pathlib import Path

import numpy as np
import pytest
from conftest import COARSE

import frictionsim

MANY_DIGITS = 1e-11
"""VTU files keep twelve digits of a mode's frequency."""


def test_tables_are_columns_of_numbers(disc: frictionsim.Case) -> None:
    pandas = pytest.importorskip("pandas")
    result = frictionsim.cea(disc)
    eigenvalues = result.eigenvalues
    assert eigenvalues["frequency_hz"].dtype == float
    assert eigenvalues["mode"].dtype == int
    assert eigenvalues["unstable"].dtype == bool
    np.testing.assert_array_equal(eigenvalues["unstable"], eigenvalues["real_hz"] > 0)
    frame = eigenvalues.to_pandas()
    read = pandas.read_csv(result.folder / "eigenvalues.csv")
    pandas.testing.assert_frame_equal(frame, read, rtol=1e-15, atol=0.0)
    assert "frequency_hz" in eigenvalues._repr_html_()
    assert result.sensitivities.rows > 0
    with pytest.raises(KeyError, match="no column"):
        eigenvalues["nothing"]
    with pytest.raises(AttributeError, match="tables are"):
        _ = result.nothing


def test_columns_are_not_copied(disc: frictionsim.Case) -> None:
    eigenvalues = frictionsim.cea(disc, figures=False).eigenvalues
    column = eigenvalues["frequency_hz"]
    # NumPy looks at the memory in which the compiled part has read the table, and each look is at the same memory.
    assert not column.flags.owndata and column.flags.writeable
    assert eigenvalues["frequency_hz"] is column


def test_fields_open_in_pyvista(disc: frictionsim.Case) -> None:
    pytest.importorskip("pyvista")
    mode = frictionsim.cea(disc, figures=False).modes[0]
    grid = mode.mesh.to_pyvista()
    np.testing.assert_array_equal(grid.points, mode.mesh.points)
    assert grid.n_cells == len(mode.mesh.cells)
    np.testing.assert_array_equal(grid.point_data["displacement_real"], mode.shape.real)


def test_modes_have_complex_shapes_on_the_mesh(disc: frictionsim.Case) -> None:
    result = frictionsim.cea(disc)
    at = result.eigenvalues["friction_coefficient"] == 0.3
    assert len(result.modes) == at.sum()
    frequencies = [mode.frequency_hz for mode in result.modes]
    np.testing.assert_allclose(frequencies, result.eigenvalues["frequency_hz"][at], rtol=MANY_DIGITS)
    mode = result.modes[0]
    assert mode.shape.shape == result.mesh.points.shape and np.iscomplexobj(mode.shape)
    # The outer rim is clamped.
    radius = np.hypot(*result.mesh.points[:, :2].T)
    assert np.all(mode.shape[np.isclose(radius, 0.0905)] == 0)
    assert np.abs(mode.shape).max() > 0
    cells = result.mesh.cells
    assert len(cells) > 0 and cells[-1].max() < len(result.mesh.points) and cells.offsets[-1] == len(cells.connectivity)


def test_a_transient_gives_probes_contact_and_snapshots() -> None:
    case = frictionsim.Case.shipped("polycarbonate-610rpm").changed(COARSE)
    run = {"transient.duration": 1e-3, "output.probes": [1], "output.snapshots": [2e-4, 5e-4]}
    result = frictionsim.transient(case, figures=False, **run)
    probe = result.probes["1"]
    assert probe["time_s"][-1] == pytest.approx(1e-3, rel=1e-2)
    total = sum(result.contact[name] for name in ("stick", "slip", "open"))
    np.testing.assert_allclose(total, 1.0, atol=1e-12)
    assert result.contact_history["status"].shape == (result.contact.rows, 16)
    assert [time for time, _ in result.snapshots] == pytest.approx([2e-4, 5e-4], abs=2e-6)
    assert "pressure_pa" in " ".join(result.snapshots[0][1].point_data)
    assert not result.settled


def test_figures_show_in_a_notebook(disc: frictionsim.Case) -> None:
    result = frictionsim.cea(disc)
    locus = result.figures["locus"]
    assert locus._repr_svg_().startswith("<svg") or "<svg" in locus.svg[:400]
    assert locus.png.startswith(b"\x89PNG")
    page = result._repr_html_()
    assert page.count("<img") == len(result.figures) > 2 and "dofs" in page
    with pytest.raises(KeyError, match="locus"):
        result.figures["nothing"]


def test_a_temporary_folder_goes_with_its_result(disc: frictionsim.Case, tmp_path: Path) -> None:
    result = frictionsim.cea(disc, figures=False)
    folder = result.folder
    kept = result.save(tmp_path / "kept")
    # What is taken of it keeps it.
    modes, figures = result.modes, result.figures
    del result
    gc.collect()
    assert modes[0].frequency_hz > 0 and len(figures) == 0
    del modes, figures
    gc.collect()
    assert not folder.exists() and (kept / "eigenvalues.csv").exists()
    assert isinstance(frictionsim.open_results(kept), frictionsim.CeaResult)


def test_the_matrices_have_the_eigenvalues_of_the_analysis() -> None:
    """Solve the quadratic eigenvalue problem with SciPy, by linearisation about a shift."""
    scipy = pytest.importorskip("scipy")
    import scipy.sparse as sparse
    from scipy.sparse.linalg import LinearOperator, eigs, splu

    case = frictionsim.Case.shipped("sliding-block")
    matrices = frictionsim.matrices(case)
    case["cea.friction_coefficients"] = [0.5]
    M, C, K = matrices.M, matrices.C, matrices.K
    assert isinstance(K, sparse.csr_array) and K.shape == (matrices.unknowns.rows,) * 2
    found = frictionsim.cea(case, figures=False).eigenvalues
    wanted = 2 * np.pi * (found["real_hz"] + 1j * found["frequency_hz"])[:4]
    n, shift = M.shape[0], 1j * wanted[0].imag
    lu = splu((shift**2 * M + shift * C + K).tocsc())

    def apply(x: np.ndarray) -> np.ndarray:
        """``(A - shift B)^-1 B x`` of the first companion form."""
        u, v = x[:n], x[n:]
        right = -(M @ (v + shift * u)) - C @ u
        inner = lu.solve(right)
        return np.concatenate([inner, u + shift * inner])

    operator = LinearOperator((2 * n, 2 * n), matvec=apply, dtype=complex)
    values = shift + 1 / eigs(operator, k=8, return_eigenvectors=False, tol=1e-12)
    for eigenvalue in wanted:
        assert np.abs(values - eigenvalue).min() < 1e-7 * abs(eigenvalue), scipy.__version__
    with pytest.raises(ValueError, match="pressed"):
        matrices.at(0.0)
    alone = frictionsim.matrices(case, friction=0.5)
    assert abs(alone.K - K).max() <= 1e-12 * abs(K).max() and alone.friction_range == (0.5, 0.5)
    # Friction coefficients that the analysis has not looked at are not claimed.
    assert frictionsim.matrices(case).friction_range == (0.5, 0.5)


def test_a_fit_can_be_laid_over_its_case() -> None:
    case = frictionsim.Case.shipped("fit-table-1").changed({"mesh.circumferential_elements": 48, "mesh.radial_elements": 8})
    fitted = frictionsim.fit(case, case.path.parent / "table-1.csv", figures=False)
    assert set(fitted.values) == set(case["fit.parameters"])
    for key, found in fitted.parameters.items():
        assert found["low"] <= found["value"] <= found["high"], key
    assert fitted.residuals.rows > 3
    assert frictionsim.check(case, **fitted.values)["valid"]
