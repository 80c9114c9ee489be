"""The border to trimesh: texts go in tidied, geometries come out as parts, exceptions as one line.

Knows nothing of what a format means.
"""

from __future__ import annotations

import codecs
import contextlib
import logging
import re
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from renderer.errors import LucidaError
from renderer.scene.limits import TEXT_MODEL_BYTES
from renderer.scene.model import Material
from renderer.scene.parts import Part, linear_colors
from renderer.scene.reading import read_file

_SILENT = logging.NullHandler()
_COMMENT_LINE = re.compile(rb"^[ \t]*#[^\n]*", re.MULTILINE)


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


def read_text(path: Path) -> str:
    """The tidy text of a model; what is not UTF-8 is replaced. Raises LucidaError."""
    return read_text_bytes(path).decode("utf-8", "replace")


def read_text_bytes(path: Path) -> bytes:
    """The tidy text of a model, in UTF-8 or nearly so. Raises LucidaError, also for what is no
    text: noise would be searched for lines, which takes long."""
    data = _as_utf8(read_file(path, TEXT_MODEL_BYTES))
    if b"\0" in data:
        problem, remedy = "holds zero bytes: it is no text", "export it again, as text in UTF-8"
        raise LucidaError("", problem, remedy, str(path))
    return tidy(data)


def _as_utf8(data: bytes) -> bytes:
    """A text in UTF-16, which its first two bytes tell, as one in UTF-8; others as they are."""
    for mark, encoding in ((codecs.BOM_UTF16_LE, "utf-16-le"), (codecs.BOM_UTF16_BE, "utf-16-be")):
        if data.startswith(mark):
            return data[2:].decode(encoding, "replace").encode()
    return data


def tidy(data: bytes) -> bytes:
    """A text with newlines only, none of them after a backslash: what that continues is one line.

    It begins and ends with a newline; otherwise lines keep their number.
    """
    text = data.removeprefix(codecs.BOM_UTF8)
    if b"\r" in text:
        text = text.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    text = b"\n%s\n" % text
    if b"\\\n" in text:  # a backslash continues its line, unless that is a comment: # C:\models\
        text = _COMMENT_LINE.sub(lambda line: line[0].rstrip(b"\\"), text)
        text = text.replace(b"\\\n", b" ")
    return text


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
