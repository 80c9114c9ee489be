"""The border to trimesh: geometries come out as parts, exceptions as one line.

Knows nothing of what a format means.
"""

from __future__ import annotations

import contextlib
import logging
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from renderer.errors import LucidaError
from renderer.scene.model import Material
from renderer.scene.parts import Part, linear_colors

_SILENT = logging.NullHandler()


@contextlib.contextmanager
def guarded(path: Path, kind: str) -> Iterator[None]:
    """Any exception inside becomes a LucidaError that names the file; warnings are not shown."""
    logging.getLogger("trimesh").addHandler(_SILENT)  # it logs what it also raises
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


def geometries(found: dict[str, Any], name: str) -> list[tuple[str, dict[str, Any]]]:
    """trimesh's answer as (name, fields of a geometry), whether it found one or several."""
    if "geometry" in found:
        return list(found["geometry"].items())
    return [(name, found)]


def to_part(name: str, fields: dict[str, Any], material: Material | None = None) -> Part:
    """A geometry of trimesh's as a part; its colours are sRGB."""
    return Part(
        str(name),
        fields.get("vertices"),
        fields.get("faces"),
        fields.get("vertex_normals"),
        linear_colors(fields.get("vertex_colors")),
        linear_colors(fields.get("face_colors")),
        material,
    )


def damaged(path: Path, problem: str) -> LucidaError:
    """The error for a file that is not what its ending or its header says."""
    return LucidaError("", problem, "it is cut off or of another kind; export it again", str(path))
