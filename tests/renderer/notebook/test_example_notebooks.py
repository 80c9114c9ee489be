"""The notebooks in docs/notebooks/ run from top to bottom, and are stored without outputs."""

import json
from itertools import chain
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

ROOT = Path(__file__).parents[3]
LARGEST = 100_000  # characters of a cell's output


@pytest.mark.filterwarnings("ignore")  # of Jupyter's own packages
def test_they_run_from_top_to_bottom(monkeypatch):
    """One after another in one kernel, whose names are cleared in between: it starts slowly."""
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    books = [nbformat.read(path, 4) for path in sorted((ROOT / "docs/notebooks").glob("*.ipynb"))]
    assert len(books) == 3
    for book in books:
        book.cells = [cell for cell in book.cells if cell.cell_type == "code"]
        assert not any(cell.outputs for cell in book.cells)
        book.cells.append(nbformat.v4.new_code_cell("%reset -f"))
    whole = nbformat.v4.new_notebook(cells=list(chain(*(book.cells for book in books))))
    NotebookClient(whole, timeout=120).execute()
    for book in books:
        outputs = [output for cell in book.cells for output in cell.outputs]
        assert not [output.text for output in outputs if output.get("name") == "stderr"]
        assert max(len(json.dumps(output)) for output in outputs) < LARGEST
        kinds = {kind for output in outputs for kind in output.get("data", ())}
        assert {"text/plain", "application/vnd.jupyter.widget-view+json"} <= kinds
