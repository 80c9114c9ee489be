"""An autograder's end of results.json, from Gradescope's documentation alone.

Its specification names the fields of the file and of a test, which are optional and what they may
be. What it does not name is refused here, so that a report that drifts away from it is noticed.
"""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

VISIBILITY = ("hidden", "after_due_date", "after_published", "visible")
FORMATS = ("text", "html", "simple_format", "md", "ansi")

NUMBER, TEXT = (int, float), (str,)
FILE_FIELDS: dict[str, tuple[type, ...]] = {
    "score": NUMBER,
    "execution_time": NUMBER,
    "output": TEXT,
    "output_format": TEXT,
    "test_output_format": TEXT,
    "test_name_format": TEXT,
    "visibility": TEXT,
    "stdout_visibility": TEXT,
    "extra_data": (dict,),
    "tests": (list,),
    "leaderboard": (list,),
}
TEST_FIELDS: dict[str, tuple[type, ...]] = {
    "score": NUMBER,
    "max_score": NUMBER,
    "status": TEXT,
    "name": TEXT,
    "name_format": TEXT,
    "number": TEXT,
    "output": TEXT,
    "output_format": TEXT,
    "tags": (list,),
    "visibility": TEXT,
    "extra_data": (dict,),
}


@dataclass(frozen=True)
class Shown:
    """The part that a student sees. score: None if it is not shown. tests: name, status, output."""

    score: float | None
    output: str
    tests: tuple[tuple[str, str, str], ...]


def published(path: Path) -> Shown:
    """Reads results.json as the service would, strictly; gives what the student sees of it."""
    content = path.read_bytes()
    text = content.decode("utf-8")
    assert "\\u0000" not in text and "\x00" not in text, "a database takes no NUL"
    results = json.loads(text, parse_constant=_refused)
    _check(results, FILE_FIELDS)
    tests = results.get("tests", [])
    for test in tests:
        _check(test, TEST_FIELDS)
        assert test.get("status", "passed") in ("passed", "failed")
        assert "score" in results or "score" in test
        assert 0 <= test.get("score", 0) <= test.get("max_score", math.inf)
    assert "score" in results or tests
    total = results.get("score", sum(test.get("score", 0) for test in tests))
    assert total >= 0
    by_default = results.get("visibility", "visible")
    seen = [test for test in tests if test.get("visibility", by_default) == "visible"]
    # Hidden tests hide the total, unless they are hidden for good and carry no points.
    others = [test for test in tests if test not in seen]
    is_shown = all(
        test.get("visibility") == "hidden" and not test.get("max_score") for test in others
    )
    return Shown(
        total if is_shown else None,
        results.get("output", ""),
        tuple((test["name"], test["status"], test.get("output", "")) for test in seen),
    )


def _check(table: Any, fields: dict[str, tuple[type, ...]]) -> None:
    assert isinstance(table, dict)
    for name, value in table.items():
        assert name in fields, f"{name} is not in the documentation"
        assert isinstance(value, fields[name]) and not isinstance(value, bool), (name, value)
        if name.endswith("visibility"):
            assert value in VISIBILITY, (name, value)
        if name.endswith("_format"):
            assert value in FORMATS, (name, value)


def _refused(constant: str) -> Any:
    raise AssertionError(f"{constant} is not JSON")
