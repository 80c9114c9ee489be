"""The import path of a test, for a process that the test starts."""

from __future__ import annotations

import os
from pathlib import Path

SUPPORT = Path(__file__).parent


def import_path(test: str) -> str:
    """PYTHONPATH for the product, for these modules, and for those beside the test's file."""
    return os.pathsep.join(map(str, (SUPPORT.parents[1], SUPPORT, Path(test).parent)))
