"""The input of a format's reader, and the user's options."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.intrinsics import PixelOrigin
from lucida.renderer.files.reading import decode_text, path_of, read_file
from lucida.renderer.system.errors import LucidaError

LARGEST_BYTES = 1 << 28  # a COLMAP model of some ten thousand images


@dataclass(frozen=True)
class Options:
    """The command's options.

    pixel_origin: None for the format's own. size: for cameras that have none.
    """

    pixel_origin: PixelOrigin | None = None
    size: Size | None = None


@dataclass(frozen=True)
class Given:
    """A file, a folder (data is empty), or pasted text (path is None).

    name: for errors. Properties raise LucidaError if their content is missing or malformed.
    """

    name: str
    data: bytes = b""
    path: Path | None = None

    @cached_property
    def text(self) -> str:
        return decode_text(self.data, self.name)

    @cached_property
    def is_text(self) -> bool:
        """True if the data can be text, which a format can then examine without an error."""
        try:
            return bool(self.text.strip()) and "\0" not in self.text
        except LucidaError:
            return False

    @cached_property
    def json(self) -> Any:
        """The content of a JSON file; None if it is not JSON."""
        try:
            return from_json(self.text) if self.is_text else None
        except LucidaError:
            return None

    @property
    def ending(self) -> str:
        return self.path.suffix.lower() if self.path is not None else ""

    @property
    def is_folder(self) -> bool:
        return self.path is not None and self.path.is_dir()


def from_json(text: str) -> Any:
    """Parse JSON. Raises LucidaError naming the line and column of the error."""
    try:
        return json.loads(text)
    except json.JSONDecodeError as error:
        where = f"line {error.lineno}, column {error.colno}"
        reason = error.msg[:1].lower() + error.msg[1:]
        raise LucidaError(where, reason, "correct the JSON there") from None
    except RecursionError:
        raise LucidaError("", "is nested too deeply", "write it with fewer brackets") from None
    except ValueError:  # Python's limit on the digits of an int
        raise LucidaError("", "holds a number of too many digits", "shorten it") from None


def given(source: str | Path) -> Given:
    """Return a file or a folder as input. Raises LucidaError."""
    path = path_of(source, "camera")
    try:
        if path.is_dir():
            return Given(str(source), path=path)
    except (OSError, ValueError):
        pass  # read_file() reports the error
    return Given(str(source), read_file(path, LARGEST_BYTES), path)
