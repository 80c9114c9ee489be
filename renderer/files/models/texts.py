"""Read models that are text: within bounds, in one encoding, with one kind of line end."""

from __future__ import annotations

import codecs
import re
from pathlib import Path

from lucida.renderer.files.reading import read_file
from lucida.renderer.scene.limits import TEXT_MODEL_BYTES
from lucida.renderer.system.errors import LucidaError

_COMMENT_LINE = re.compile(rb"^[ \t]*#[^\n]*", re.MULTILINE)


def read_text_bytes(path: Path) -> bytes:
    """Return the tidy text of a model, in UTF-8 or nearly so. Raises LucidaError, also for noise,
    which would be searched for lines for a long time.
    """
    data = read_file(path, TEXT_MODEL_BYTES)
    if b"\0" in data:
        problem, remedy = "holds zero bytes: it is no text", "export it again, as text in UTF-8"
        raise LucidaError("", problem, remedy, str(path))
    return tidy(data)


def tidy(data: bytes) -> bytes:
    """Return a text with newlines only, and with continued lines (a backslash at the end) joined.

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
