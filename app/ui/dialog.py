"""A box that asks for the path of a file, on systems without file dialogs.

The bundle's own dialog is not used, because it ends the process if there is no icon theme.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from lucida.renderer.system.atomic import check_writable
from lucida.renderer.system.errors import LucidaError, one_line

from .entry_box import EntryBox

TITLE = "###file dialog"
PATH_EM = 30.0


@dataclass(frozen=True)
class FileQuestion:
    """A question for files.

    title: the title of the box.
    saves: True to ask for a name to save under; the file need not exist.
    endings: the files' extensions; ("",) for a folder to write into, which may exist.
    name: the initial name, or a whole path.
    chosen: called with the paths.
    """

    title: str
    saves: bool
    endings: tuple[str, ...]
    name: str
    chosen: Callable[[list[str]], None]


class FileDialog:
    """The box. folder: the last file's folder, to which a name without a folder refers."""

    def __init__(self) -> None:
        self.question: FileQuestion | None = None
        self.folder = Path.cwd()
        self._box: EntryBox | None = None
        self._replace: Path | None = None  # an existing file that the user may replace

    @property
    def is_open(self) -> bool:
        return self.question is not None

    def ask(self, question: FileQuestion) -> None:
        path = Path(question.name)
        if path.is_absolute():
            self.folder = path.parent
        self.question, self._replace = question, None
        rule = f"a name in {one_line(str(self.folder))}, or a whole path"
        fields, word = {"path": one_line(path.name)}, "Save" if question.saves else "Open"
        self._box = EntryBox(f"{question.title}{TITLE}", fields, word, rule, self._enter, PATH_EM)

    def cancel(self) -> None:
        self.question = self._box = None

    def draw(self) -> None:
        """Draw the box if it is open."""
        box = self._box
        if box is not None and not box.draw() and box is self._box:
            self.cancel()

    def _enter(self, texts: tuple[str, ...]) -> None:
        """Answer with the file, if it exists or is to be saved. Raises LucidaError."""
        question = self.question
        assert question is not None
        path = self.folder / os.path.expanduser(texts[0].strip())
        if not question.saves:
            if not path.exists():
                raise LucidaError("", "does not exist", "give another path", str(path))
        else:
            if not path.name.lower().endswith(question.endings):
                path = path.with_name(path.name + question.endings[0])
            if question.endings != ("",):
                check_writable(path)
            if path.is_file() and path != self._replace:
                self._replace = path
                problem = f"{one_line(path.name)} is there already"
                raise LucidaError("", problem, "press Enter again to replace it")
        self.folder = path.parent
        self.cancel()
        question.chosen([str(path)])
