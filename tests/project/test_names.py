"""The files that docstrings and comments name are there."""

from __future__ import annotations

import re

from test_layers import MODULES


def test_the_files_that_texts_name_are_there() -> None:
    """Docstrings and comments, which no linter reads: `laboratory/pages.py`."""
    there = [path.as_posix() for path in MODULES.values()]
    named = [
        (module, name)
        for module, path in MODULES.items()
        for name in re.findall(r"(?<![\w/.])\w+(?:/\w+)+\.py\b", path.read_text("utf-8"))
    ]
    assert len(named) > 5
    assert not [entry for entry in named if not any(p.endswith(f"/{entry[1]}") for p in there)]
