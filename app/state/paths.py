"""Paths of files as text for any file format, and back.

A name need not be UTF-8. Python then puts lone surrogates into it, which JSON and the window's
texts do not accept. Show paths with lucida.renderer.system.errors.one_line(); save them with
stored().
"""

from __future__ import annotations

import re

_LONE = re.compile("[\ud800-\udfff]")
_STORED = re.compile("\0([0-9a-f]{4})")  # no path holds zero bytes


def stored(path: str) -> str:
    """Return the path as text without lone surrogates."""
    return _LONE.sub(lambda match: f"\0{ord(match[0]):04x}", path)


def is_unicode(path: str) -> bool:
    """Return True if the path has no lone surrogates, so that UTF-8 can hold it."""
    return _LONE.search(path) is None


def restored(text: str) -> str:
    """Return the path that was passed to stored()."""
    return _STORED.sub(lambda match: chr(int(match[1], 16)), text)
