"""Cases: values, changes, errors."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import frictionsim
from frictionsim import Case, CaseError, UsageError


def test_keys_are_read_changed_and_taken_away() -> None:
    case = Case.shipped("polycarbonate-disc")
    assert case["contact.rotation_speed_rpm"] == 610.0
    assert case["mesh"]["element"] == "quad8"
    case["contact.rotation_speed_rpm"] = np.float64(70.0)
    case["output.probes"] = np.array([1, 2])
    del case["cea.shapes_at"]
    assert case["contact.rotation_speed_rpm"] == 70.0
    assert case["output.probes"] == [1, 2]
    assert "cea.shapes_at" not in case
    with pytest.raises(KeyError, match="does not give"):
        case["transient.duration"]
    assert "contact.friction_coefficient" in list(case)
    assert len(case) == len(list(case))


def test_a_written_case_keeps_its_comments_and_means_the_same(tmp_path: Path) -> None:
    case = Case.shipped("polycarbonate-disc")
    case["contact.friction_coefficient"] = 0.45
    case["boundaries.outer"] = {"condition": "support", "normal_stiffness": 1e12, "tangential_stiffness": 1e12}
    del case["cea.shapes_at"]
    path = case.write(tmp_path / "own.toml")
    text = path.read_text()
    assert "# m" in text and "friction_coefficient = 0.45" in text and "shapes_at" not in text
    assert Case(path).values_by_section() == case.values_by_section()
    assert Case(path).check()["case_hash"] == case.check()["case_hash"]


def test_a_written_case_finds_its_mesh_from_its_new_place(tmp_path: Path) -> None:
    case = Case.shipped("sliding-block")
    written = Case(case.write(tmp_path / "block.toml"))
    assert written.validate() == case.validate()
    assert written["mesh.file"] != case["mesh.file"]


def test_a_written_case_finds_its_matrices_from_its_new_place(tmp_path: Path) -> None:
    (tmp_path / "part").mkdir()
    (tmp_path / "part" / "k.mtx").write_text("%%MatrixMarket matrix coordinate real general\n1 1 1\n1 1 1.0\n")
    text = '[superelements.a]\nmass = "k.mtx"\nstiffness = "k.mtx"\n[cea]\nmodes = 1\n'
    (tmp_path / "part" / "own.toml").write_text(text)
    written = Case(Case(tmp_path / "part" / "own.toml").write(tmp_path / "own.toml"))
    assert written["superelements.a.mass"] == written["superelements.a.stiffness"] == "part/k.mtx"


def test_every_shipped_case_is_there_with_its_files(tmp_path: Path) -> None:
    names = frictionsim.shipped_cases()
    assert len(names) > 20
    for name in names:
        Case.shipped(name).validate()
    written = frictionsim.write_shipped_cases(tmp_path)
    assert {path.stem for path in written if path.suffix == ".toml"} >= set(names)
    with pytest.raises(UsageError, match="no shipped case"):
        Case.shipped("nothing")


def test_a_mesh_file_suggests_a_case(tmp_path: Path) -> None:
    frictionsim.write_shipped_cases(tmp_path)
    mesh = tmp_path / "meshes" / "tread-block.msh"
    assert frictionsim.init(mesh)["mesh.file"] == mesh.name
    with pytest.raises(FileExistsError):
        frictionsim.init(mesh)
    frictionsim.init(mesh, force=True).validate()


def test_columns_are_found_by_a_word() -> None:
    found = frictionsim.columns("growth_rate_per_s")
    assert any((own["file"], own["unit"]) == ("eigenvalues.csv", "1/s") for own in found)


def test_an_error_in_the_file_says_line_key_and_remedy() -> None:
    text = Case.shipped("polycarbonate-disc").text.replace("shapes_at", "shape_at")
    case = Case.parse(text)
    with pytest.raises(CaseError) as caught:
        frictionsim.cea(case)
    error = caught.value
    line = next(i for i, line in enumerate(text.splitlines(), 1) if "shape_at" in line)
    assert error.line == line
    assert error.column == 1
    assert error.key == "cea.shape_at"
    assert error.suggestion == "did you mean `shapes_at`?"
    assert error.file == str(case.path)
    assert "shape_at" in str(error) and isinstance(error, ValueError)


def test_an_error_in_the_call_says_its_key() -> None:
    case = Case.shipped("polycarbonate-disc")
    with pytest.raises(CaseError) as caught:
        frictionsim.cea(case, **{"contact.friction_coefficient": -0.3, "contact.interferance": 1e-6})
    keys = [error.key for error in caught.value.errors]
    assert keys == ["contact.interferance", "contact.friction_coefficient"] or set(keys) == {
        "contact.interferance",
        "contact.friction_coefficient",
    }
    assert {error.file for error in caught.value.errors} == {"--set"}
    with pytest.raises(CaseError, match="transient"):
        frictionsim.transient(case)


@pytest.mark.parametrize("value", [object(), {1, 2}, b"0.3", 1j])
def test_values_that_no_case_takes_are_refused_with_their_key(value: object) -> None:
    with pytest.raises(TypeError, match=r"contact\.friction_coefficient"):
        frictionsim.cea(Case.shipped("polycarbonate-disc"), **{"contact.friction_coefficient": value})


@pytest.mark.parametrize(
    "value", [float("nan"), float("inf"), "much", [0.1, 0.2], np.zeros((2, 2)), True, {"from": 0.0}, 10**30, "\x00", ""]
)
def test_values_of_the_wrong_kind_are_case_errors(value: object) -> None:
    with pytest.raises(CaseError) as caught:
        frictionsim.cea(Case.shipped("polycarbonate-disc"), **{"contact.friction_coefficient": value})
    assert caught.value.key == "contact.friction_coefficient"


def test_files_and_folders_that_cannot_be_are_usage_errors(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="cannot read"):
        frictionsim.cea(tmp_path / "nothing.toml")
    with pytest.raises(UsageError, match="cannot read"):
        frictionsim.cea(tmp_path)
    precious = tmp_path / "precious"
    precious.mkdir()
    (precious / "thesis.txt").write_text("all of it")
    with pytest.raises(UsageError, match="thesis"):
        frictionsim.cea(Case.shipped("polycarbonate-disc"), folder=precious)
    assert (precious / "thesis.txt").read_text() == "all of it"
    with pytest.raises(UsageError, match=r"summary\.json"):
        frictionsim.open_results(tmp_path)


def test_a_case_that_is_no_text_is_an_error(tmp_path: Path) -> None:
    path = tmp_path / "bytes.toml"
    for content in (b"\xff\xfe\x00", b"\xff" * 100, b"[", b"a = 1\na = 2\n"):
        path.write_bytes(content)
        with pytest.raises(CaseError):
            frictionsim.cea(path)
        with pytest.raises(frictionsim.FrictionsimError):
            Case(path).validate()


def test_check_says_what_runs_cost() -> None:
    found = frictionsim.check(Case.shipped("polycarbonate-disc"))
    assert found["valid"] and found["dofs"] > 10_000 and found["cea"]["friction_values"] == 51
    assert any(key["name"] == "contact.friction_coefficient" for key in frictionsim.case_keys())
