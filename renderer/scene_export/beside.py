"""The files next to a scene's: one for each different mesh, picture or lobe, however often it is
used.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Hashable
from functools import partial

LONGEST = 40  # characters of an object's name in a file's name


class FilesBeside:
    """Names and contents of the files. stem: of the scene's file name."""

    def __init__(self, stem: str) -> None:
        self._stem = stem
        self._names: dict[tuple[Hashable, ...], str] = {}
        self.contents: dict[str, Callable[[], bytes]] = {}

    def file(
        self, kind: str, ending: str, name: str, make: Callable[..., bytes], *inputs: Hashable
    ) -> str:
        """Return the path, relative to the scene's folder, of the file that holds make(*inputs).

        kind: the suffix of its folder's name. name: of the first object that uses it. The inputs
        are the key: the same file is made only once.
        """
        key = (make, *inputs)
        if key not in self._names:
            plain = re.sub(r"[^A-Za-z0-9_.-]+", "-", name).strip("-.")[:LONGEST]
            number = sum(known[0] == make for known in self._names)
            file = f"{self._stem}_{kind}/{number}{f'-{plain}' if plain else ''}.{ending}"
            self._names[key] = file
            self.contents[file] = partial(make, *inputs)
        return self._names[key]
