"""The border to trimesh: whatever happens behind it comes back as one line.

Knows nothing of formats.
"""

from __future__ import annotations

import contextlib
import logging
import warnings
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from renderer.errors import LucidaError


@contextlib.contextmanager
def guarded(path: Path, kind: str) -> Iterator[None]:
    """Any exception inside becomes a LucidaError that names the file; warnings are not shown."""
    logging.getLogger("trimesh").addHandler(logging.NullHandler())  # it logs what it also raises
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            # numpy warns where it stops reading numbers early: the file is not what it seems.
            warnings.filterwarnings("error", message=".*unmatched data.*")
            yield
    except LucidaError:
        raise
    except MemoryError:
        raise LucidaError(
            "", "does not fit into memory", "give a smaller model", str(path)
        ) from None
    except Exception as error:
        # trimesh and numpy raise what they like for a damaged file: any of it means the same.
        reason = (str(error).strip().splitlines() or [type(error).__name__])[0][:120]
        raise LucidaError(
            "",
            f"cannot be read as {kind}: {reason}",
            "it is damaged or of another kind; export it again, as triangles",
            str(path),
        ) from None
