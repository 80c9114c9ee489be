"""The window's own file dialog, for systems without one: to open files, or to name one to save.

It can be used without a mouse: type a name or a path, or select with the arrow keys; Enter opens,
Backspace goes up, Escape cancels. app/ui/folders.py reads the folders. The bundle's own dialog
is not used, because it ends the process if there is no icon theme.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from imgui_bundle import imgui

from lucida.app.ui import folders, theme
from lucida.app.ui.background import Background
from lucida.app.ui.checks import checkbox
from lucida.app.ui.folders import FolderContent, starting_points
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


class FileDialog:
    """The file dialog."""

    def __init__(self) -> None:
        self._reader: Background[FolderContent] = Background("lucida-folder")
        self.question: FileQuestion | None = None
        self.listing = FolderContent(Path.cwd())
        self._places: list[tuple[str, Path]] = []
        self._name = ""
        self._marked: set[str] = set()
        self._all_files = False
        self._replace = ""  # an existing file that the user may replace
        self._appearing = False
        self._typing = False  # whether the name is to have the keyboard

    @property
    def is_open(self) -> bool:
        return self.question is not None

    @property
    def folder(self) -> Path:
        return self.listing.folder

    def ask(self, question: FileQuestion) -> None:
        path = Path(question.name)
        if path.is_absolute():
            question = replace(question, name=path.name)
            self.go(path.parent)
        self.question, self._name, self._replace = question, question.name, ""
        self._appearing, self._places = True, starting_points()
        self.go(self.listing.folder)

    def cancel(self) -> None:
        self.question = None

    def close(self) -> None:
        self._reader.close(0.2)

    def draw(self) -> None:
        """Draw the dialog if it is open."""
        question = self.question
        if question is None:
            return
        read = self._reader.poll()
        listing = read.value if read is not None else None
        if listing is not None and listing.folder == self.folder:
            self.listing, self._marked = listing, set()
        viewport = imgui.get_main_viewport()
        em = imgui.get_font_size()
        size = box_width(46, 0.92), min(30 * em, 0.86 * viewport.work_size.y)
        imgui.set_next_window_pos(viewport.get_center(), imgui.Cond_.appearing, (0.5, 0.5))
        imgui.set_next_window_size(size, imgui.Cond_.appearing)
        flags, child = imgui.WindowFlags_, imgui.ChildFlags_
        if self._appearing:
            imgui.set_next_window_focus()
        _, still_open = imgui.begin(
            f"{question.title}{TITLE}",
            True,
            flags.no_docking | flags.no_collapse | flags.no_saved_settings,
        )
        self._path_line()
        footer = 2 * imgui.get_frame_height_with_spacing() + imgui.get_style().item_spacing.y
        imgui.begin_child("##places", (8 * em, -footer), child.nav_flattened)
        for name, folder in self._places:
            if imgui.selectable(name, folder == self.listing.folder)[0]:
                self.go(folder)
        imgui.end_child()
        imgui.same_line()
        imgui.begin_child("##entries", (0, -footer), child.borders | child.nav_flattened)
        self._entries(question)
        imgui.end_child()
        self._name_line(question)
        imgui.end()
        self._appearing = False
        # A text that is being typed would keep Escape for itself.
        if not still_open or (self.is_open and imgui.is_key_pressed(imgui.Key.escape, False)):
            self.cancel()

    def _path_line(self) -> None:
        """Draw the parent folders, each as a button."""
        parts = [*reversed(self.listing.folder.parents), self.listing.folder]
        for index, folder in enumerate(parts[-6:]):
            if index:
                imgui.same_line(0, 2)
            if imgui.small_button(f"{one_line(folder.name or str(folder))}##up{index}"):
                self.go(folder)

    def _entries(self, question: FileQuestion) -> None:
        listing = self.listing
        if listing.error:
            error = one_line(listing.error)
            imgui.text_colored(theme.ERROR, f"this folder cannot be read: {error}")
        at_home = imgui.is_window_focused() and not imgui.is_any_item_active()
        if at_home and imgui.is_key_pressed(imgui.Key.backspace):
            self.go(listing.folder.parent)
        for name in listing.folders:
            if imgui.selectable(f"{one_line(name)}/", False)[0]:
                self.go(listing.folder / name)
        double = imgui.SelectableFlags_.allow_double_click
        for name in listing.files:
            if not imgui.selectable(one_line(name), name in self._marked, double)[0]:
                continue
            if imgui.get_io().key_ctrl and not question.saves:
                self._marked ^= {name}
            else:
                self._marked = {name}
            self._name = one_line(name)
            by_key = imgui.is_key_pressed(imgui.Key.enter)
            if imgui.is_mouse_double_clicked(imgui.MouseButton_.left) or by_key:
                self._finish(question)
        if not (listing.folders or listing.files or listing.error or self._reader.busy):
            imgui.text_colored(theme.DIM, "nothing here that could be opened")
        if listing.cut:
            imgui.text_colored(theme.DIM, "... and more: type the name")

    def _name_line(self, question: FileQuestion) -> None:
        if self._appearing or self._typing:
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
            self._marked, self._replace = set(), ""
        word = "Save" if question.saves else "Open"
        if self._replace:
            imgui.text_colored(
                theme.ERROR, f"{one_line(Path(self._replace).name)} is there already."
            )
            imgui.same_line()
            word = "Replace"
        if imgui.button(f"{word}###answer", (7 * imgui.get_font_size(), 0)) or entered:
            self._finish(question)
        imgui.same_line()
        if imgui.button("Cancel", (7 * imgui.get_font_size(), 0)):
            self.cancel()
        if not question.saves:
            imgui.same_line()
            changed, self._all_files = checkbox("all files", self._all_files)
            if changed:
                self.go(self.listing.folder)

    def go(self, folder: Path) -> None:
        """Go to another folder at once: typed names refer to it. Its list follows when it has been
        read.
        """
        if folder != self.folder:
            self.listing, self._marked = FolderContent(folder), set()
        endings = self.question.endings if self.question is not None else ()
        wanted = () if self._all_files else endings
        self._reader.submit(lambda: folders.read_folder(folder, wanted))

    def _meant(self) -> str:
        """Return the file whose name is shown; some names cannot be shown unchanged."""
        typed = self._name.strip()
        listed = (*self._marked, *self.listing.files)
        return next((name for name in listed if one_line(name) == typed), typed)

    def _finish(self, question: FileQuestion) -> None:
        """Enter a folder that was typed or selected, or answer with a file."""
        names = sorted(self._marked) if len(self._marked) > 1 else [self._meant()]
        if names == [""]:
            return
        paths = [self.listing.folder / os.path.expanduser(name) for name in names]
        path = paths[0]
        is_answer = question.endings == FOLDER and not names[0].endswith(("/", os.sep))
        if os.path.isdir(path) and not is_answer:
            self._name, self._typing = question.name, True
            self.go(path)
            return
        if question.saves:
            if question.endings and not str(path).lower().endswith(question.endings):
                path = Path(f"{path}{question.endings[0]}")
            paths = [path]
            if path.exists() and not is_answer and self._replace != str(path):
                self._replace = str(path)
                return
        self.question = None
        question.chosen([str(path) for path in paths])
