"""The window's own file dialog, for systems without one: to open a file, or to name one to save.

The user types a name or a path, or selects one of the listed names by mouse or by arrow keys. Enter
opens it, Escape cancels. The bundle's own dialog is not used, because it ends the process if there
is no icon theme.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from imgui_bundle import imgui

from lucida.app.ui import theme
from lucida.app.ui.background import Background
from lucida.app.ui.messages import box_width
from lucida.renderer.system.errors import one_line

Chosen = Callable[[list[str]], None]
TITLE = "###file dialog"
FOLDER = ("",)  # the endings of a folder that is asked for


@dataclass(frozen=True)
class FileQuestion:
    """A question for files.

    title: on top.
    saves: ask for a name, of a file that need not exist.
    endings: of the listed files; FOLDER for a folder to write into, which may be there.
    name: the initial one; of a whole path, the last part, in that folder.
    chosen: called with the paths.
    """

    title: str
    saves: bool
    endings: tuple[str, ...]
    name: str
    chosen: Chosen


@dataclass(frozen=True)
class FolderContent:
    """A folder's content by name. error: the reason if it cannot be read."""

    folder: Path
    folders: tuple[str, ...] = ()
    files: tuple[str, ...] = ()
    error: str = ""


def read_folder(folder: Path, endings: tuple[str, ...]) -> FolderContent:
    """Read a folder, without hidden files. endings: of the files to list."""
    folders, files = [], []
    try:
        with os.scandir(folder) as entries:
            for entry in entries:
                if entry.name.startswith("."):
                    continue
                if entry.is_dir():
                    folders.append(entry.name)
                elif entry.name.lower().endswith(endings):
                    files.append(entry.name)
    except (OSError, ValueError) as error:
        return FolderContent(folder, error=one_line(str(error)))
    return FolderContent(
        folder, tuple(sorted(folders, key=str.lower)), tuple(sorted(files, key=str.lower))
    )


class FileDialog:
    """The file dialog. listing: of the present folder, as far as it has been read."""

    def __init__(self) -> None:
        self._reader: Background[FolderContent] = Background("lucida-folder")
        self.question: FileQuestion | None = None
        self.listing = FolderContent(Path.cwd())
        self._name = ""
        self._replace = ""  # an existing file that the user may replace
        self._typing = False  # whether the name is to have the keyboard

    @property
    def is_open(self) -> bool:
        return self.question is not None

    @property
    def folder(self) -> Path:
        return self.listing.folder

    def ask(self, question: FileQuestion) -> None:
        path = Path(question.name)
        self.question = question
        self.go(path.parent if path.is_absolute() else self.folder)

    def cancel(self) -> None:
        self.question = None

    def close(self) -> None:
        self._reader.close(0.2)

    def go(self, folder: Path) -> None:
        """Go to another folder at once: typed names refer to it. Its list follows when it has been
        read.
        """
        self.listing, self._replace, self._typing = FolderContent(folder), "", True
        if (question := self.question) is not None:
            self._name = Path(question.name).name
            self._reader.submit(lambda: read_folder(folder, question.endings))

    def draw(self) -> None:
        """Draw the dialog if it is open."""
        question = self.question
        if question is None:
            return
        read = self._reader.poll()
        if read is not None and read.value is not None and read.value.folder == self.folder:
            self.listing = read.value
        viewport, em = imgui.get_main_viewport(), imgui.get_font_size()
        size = box_width(46, 0.92), min(30 * em, 0.86 * viewport.work_size.y)
        imgui.set_next_window_pos(viewport.get_center(), imgui.Cond_.appearing, (0.5, 0.5))
        imgui.set_next_window_size(size, imgui.Cond_.appearing)
        if self._typing:
            imgui.set_next_window_focus()
        flags, child = imgui.WindowFlags_, imgui.ChildFlags_
        _, still_open = imgui.begin(
            f"{question.title}{TITLE}",
            True,
            flags.no_docking | flags.no_collapse | flags.no_saved_settings,
        )
        imgui.text_wrapped(one_line(str(self.folder)))
        footer = 2 * imgui.get_frame_height_with_spacing() + imgui.get_style().item_spacing.y
        imgui.begin_child("##entries", (0, -footer), child.borders | child.nav_flattened)
        self._entries(question)
        imgui.end_child()
        self._name_line(question)
        imgui.end()
        # A text that is being typed would keep Escape for itself.
        if not still_open or imgui.is_key_pressed(imgui.Key.escape, False):
            self.cancel()

    def _entries(self, question: FileQuestion) -> None:
        listing = self.listing
        if listing.error:
            imgui.text_colored(theme.ERROR, listing.error)
        for name in ("..", *listing.folders):
            if imgui.selectable(f"{one_line(name)}/", False)[0]:
                self.go(self.folder.parent if name == ".." else self.folder / name)
        double = imgui.SelectableFlags_.allow_double_click
        for name in map(one_line, listing.files):
            if imgui.selectable(name, name == self._name, double)[0]:
                self._name, self._replace = name, ""
                by_key = imgui.is_key_pressed(imgui.Key.enter)
                if by_key or imgui.is_mouse_double_clicked(imgui.MouseButton_.left):
                    self._finish(question)

    def _name_line(self, question: FileQuestion) -> None:
        if self._typing:
            imgui.set_keyboard_focus_here()
            self._typing = False
        imgui.set_next_item_width(-1)
        entered, self._name = imgui.input_text_with_hint(
            "##name",
            "a name or a path",
            self._name,
            imgui.InputTextFlags_.enter_returns_true | imgui.InputTextFlags_.auto_select_all,
        )
        if imgui.is_item_edited():
            self._replace = ""
        word = "Save" if question.saves else "Open"
        if self._replace:
            name = one_line(Path(self._replace).name)
            imgui.text_colored(theme.ERROR, f"{name} is there already.")
            imgui.same_line()
            word = "Replace"
        width = 7 * imgui.get_font_size()
        if imgui.button(f"{word}###answer", (width, 0)) or entered:
            self._finish(question)
        imgui.same_line()
        if imgui.button("Cancel", (width, 0)):
            self.cancel()

    def _finish(self, question: FileQuestion) -> None:
        """Enter a folder that was typed, or answer with a file."""
        typed = self._name.strip()
        if not typed:
            return
        # Some names cannot be shown unchanged.
        name = next((name for name in self.listing.files if one_line(name) == typed), typed)
        path = self.folder / os.path.expanduser(name)
        is_answer = question.endings == FOLDER and not name.endswith(("/", os.sep))
        if path.is_dir() and not is_answer:
            self.go(path)
            return
        if question.saves:
            if not str(path).lower().endswith(question.endings):
                path = Path(f"{path}{question.endings[0]}")
            if path.exists() and not is_answer and self._replace != str(path):
                self._replace = str(path)
                return
        self.question = None
        question.chosen([str(path)])
