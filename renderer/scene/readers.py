"""PLY, STL and OFF files through trimesh's readers.

Each count that a file declares is compared with the file's size before trimesh sees it, so that a
false one cannot set memory aside.
"""

from __future__ import annotations

import contextlib
import io
import itertools
import logging
import re
import warnings
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from renderer.errors import LucidaError
from renderer.scene.limits import BINARY_MODEL_BYTES, OBJECTS, TEXT_MODEL_BYTES, TRIANGLES
from renderer.scene.parts import Part, linear_colors
from renderer.scene.reading import check_bytes, check_count, read_file, size_texts
from renderer.scene.texts import read_text_bytes, tidy

_SOLID = re.compile(r"^[ \t]*solid\b([^\n]*)", re.MULTILINE | re.IGNORECASE)
_COUNT = re.compile(r"-?\d{1,18}")
_SILENT = logging.NullHandler()


def read_ply(path: Path) -> list[Part]:
    """Return the mesh of a .ply file, text or binary."""
    data = read_file(path, BINARY_MODEL_BYTES)
    end = re.search(rb"end_header[ \t\r]*\n", data[: 1 << 16])
    if not data.startswith(b"ply") or not end:
        raise damaged("has no PLY header")
    header, body = data[: end.end()].decode("utf-8", "replace"), data[end.end() :]
    if "ascii" in header.split("\n", 2)[1]:
        check_bytes(len(data), TEXT_MODEL_BYTES, "")
        lines = _lines(body.decode("utf-8", "replace"))
        body = "\n".join(lines).encode()
        _check_rows(_ply_rows(header, least_bytes=False), len(lines), "lines")
    else:
        _check_rows(_ply_rows(header, least_bytes=True), len(body), "bytes")
    with _guarded("PLY"):
        from trimesh.exchange.ply import load_ply

        # Edges and textures are not read: under this name trimesh does not look for edges.
        header = re.sub(r"(?m)^element edge\b", "element edges", header)
        found = load_ply(io.BytesIO(header.encode() + body), skip_materials=True)
    return _parts(found, path.stem)


def read_stl(path: Path) -> list[Part]:
    """Return the solids of an .stl file, text or binary."""
    data = read_file(path, BINARY_MODEL_BYTES)
    triangles = int.from_bytes(data[80:84], "little")
    names: list[str] = []
    if len(data) != 84 + 50 * triangles or len(data) < 84:
        if data.lstrip()[:5].lower() != b"solid":
            if len(data) < 84:
                raise damaged("is too short to be STL")
            declared, there = size_texts(84 + 50 * triangles, len(data))
            raise damaged(f"declares {triangles} triangles, {declared}, and has {there}")
        check_bytes(len(data), TEXT_MODEL_BYTES, "")
        text = tidy(data).decode("utf-8", "replace")
        solids = text.lower().count("endsolid")
        if not solids:
            raise damaged("has no 'endsolid'")
        check_count(solids, OBJECTS, "solids")
        # trimesh takes quadratic time over equal names.
        names = [match[1].strip() for match in _SOLID.finditer(text)]
        numbers = itertools.count()
        data = _SOLID.sub(lambda _: f"solid {next(numbers)}", text).encode()
    else:
        check_count(triangles, TRIANGLES, "triangles")
    with _guarded("STL"):
        from trimesh.exchange.stl import load_stl

        found = load_stl(io.BytesIO(data))
    return _parts(found, path.stem, names)


def read_off(path: Path) -> list[Part]:
    """Return the mesh of an .off file (text; vertex colours are not read)."""
    text = read_text_bytes(path).decode("utf-8", "replace")
    lines = _lines(re.sub(r"#[^\n]*", "", text))
    if lines and lines[0][:3].lower() == "off":
        lines[0] = "OFF" + lines[0][3:]
    words = " ".join(lines[:3]).split(None, 3)
    if not words or not re.fullmatch(r"[A-Z0-9]*OFF", words[0]):
        raise damaged("does not begin with OFF")
    if words[0] not in ("OFF", "COFF", "NOFF", "CNOFF", "STOFF") or words[1:2] == ["BINARY"]:
        raise LucidaError("", f"is of the kind {words[0]}", "export a plain OFF")
    first = 2 if lines[0] == words[0] else 1  # the counts may follow the keyword in its line
    _check_rows([_whole(word) for word in words[1:3]], len(lines) - first, "lines")
    with _guarded("OFF"):
        from trimesh.exchange.off import load_off

        found = load_off(io.StringIO("\n".join(lines)))
    return _parts(found, path.stem)


READERS = {".ply": read_ply, ".stl": read_stl, ".off": read_off}


def damaged(problem: str) -> LucidaError:
    """Return the error for a file that is not what its ending or its header says."""
    return LucidaError("", problem, "it is cut off or of another kind; export it again")


@contextlib.contextmanager
def _guarded(kind: str) -> Iterator[None]:
    """Turn any exception of the block into a LucidaError, and show no warnings."""
    logging.getLogger("trimesh").addHandler(_SILENT)  # it logs what it also raises
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            # numpy warns where it stops reading numbers early: the file is damaged.
            warnings.filterwarnings("error", message=".*unmatched data.*")
            yield
    except MemoryError:
        raise
    except Exception as error:
        # trimesh and numpy raise exceptions of all kinds for a damaged file.
        reason = (str(error).strip().splitlines() or [type(error).__name__])[0][:120]
        raise LucidaError(
            "",
            f"cannot be read as {kind}: {reason}",
            "it is damaged or of another kind; export it again, as triangles",
        ) from None


def _parts(found: dict[str, Any], stem: str, names: Sequence[str] = ()) -> list[Part]:
    """Return the geometries that trimesh has read, one or several. names: theirs, by number."""
    parts = []
    for number, fields in found.get("geometry", {"": found}).items():
        is_named = number.isdigit() and int(number) < len(names)
        parts.append(
            Part(
                (names[int(number)] if is_named else "") or stem,
                fields.get("vertices"),
                fields.get("faces"),
                fields.get("vertex_normals"),
                linear_colors(fields.get("vertex_colors")),
                linear_colors(fields.get("face_colors")),
            )
        )
    return parts


def _lines(text: str) -> list[str]:
    """Return the lines of a text that are not empty."""
    return [line for line in map(str.strip, text.split("\n")) if line]


def _ply_rows(header: str, least_bytes: bool) -> list[int]:
    """Return for each element of a PLY header its rows, or the fewest bytes they can have."""
    sizes = {"8": 1, "char": 1, "uchar": 1, "16": 2, "short": 2, "ushort": 2, "64": 8, "double": 8}
    rows: list[int] = []
    width: list[int] = []
    for line in header.split("\n"):
        words = line.split()
        if words[:1] == ["element"] and len(words) == 3:
            rows.append(_whole(words[2]))
            width.append(0)
        elif words[:1] == ["property"] and len(words) >= 3 and width:
            kind = words[2] if words[1] == "list" else words[1]
            width[-1] += sizes.get(kind, sizes.get(kind.lstrip("uintfloa"), 4))
    if not least_bytes:
        return rows
    return [count * max(each, 1) for count, each in zip(rows, width, strict=True)]


def _check_rows(declared: list[int], there: int, unit: str) -> None:
    if sum(declared) > there:
        raise damaged(f"declares {sum(declared)} {unit} of data and has {there}")


def _whole(word: str) -> int:
    if not _COUNT.fullmatch(word) or int(word) < 0:
        raise damaged("declares a count that is not a whole number")
    return int(word)
