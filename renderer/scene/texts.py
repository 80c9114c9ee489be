"""Models that are written as text: read within bounds, in one encoding, with lines that end alike.

Knows nothing of what a line means.
"""

from __future__ import annotations

import codecs
import re
from pathlib import Path

from renderer.errors import LucidaError
from renderer.scene.limits import TEXT_MODEL_BYTES
from renderer.scene.reading import read_file

_COMMENT_LINE = re.compile(rb"^[ \t]*#[^\n]*", re.MULTILINE)


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
