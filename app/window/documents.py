"""The documents that the window shows: Getting started and all others.

imgui_md draws their Markdown. It loads its fonts when a document is first drawn.
"""

from __future__ import annotations

import platform
import webbrowser
from collections.abc import Callable
from pathlib import Path

import moderngl
import numpy as np
from imgui_bundle import ImVec2, imgui, imgui_md

import lucida
from lucida.app.ui import theme
from lucida.app.ui.messages import wrapped

NAME = "Documentation"
WIDTH_EM, HEIGHT_EM, LIST_EM = 76.0, 44.0, 13.5
GETTING_STARTED, KEYS, ABOUT = "Getting started", "Mouse and keys", "About Lucida"
FIRST = "window.md"
COLUMNS = 3  # of Getting started
TILES = {
    "window.png": "Drag an image to turn the camera; the wheel moves closer. P switches between "
    "perspective and parallel projection, Home resets the camera.",
    "outside.png": "Click a pixel to mark it. The layout Outside view, in the menu at the right "
    "end, shows its ray from the eye to what it hits.",
    "probe.png": "The layout Probe writes out that ray in formulas, with the pixel's numbers.",
    "compare.png": "The layout Compare shows where the rasterizer and the ray tracer differ, and "
    "why. N goes to the next such pixel.",
    "loops.png": "The layout Loops runs both algorithms line by line, next to their code.",
    "lecture.png": 'Lecture > Begin "Images, rays and cameras". Page Down continues, Esc leaves '
    "the presentation.",
}
MORE = (
    "F1 shows all keys. Drop a model, a photograph, a camera file "
    "or your Python code on the window."
)


def folder() -> Path:
    """Return the documents' folder: inside the installed package, or next to it in a checkout."""
    package = Path(lucida.__file__).parent
    return next(
        (one for one in (package / "docs", package.parent / "docs") if one.is_dir()), package
    )


class Documents:
    """The box of documents.

    shown: the name of the open document, GETTING_STARTED, KEYS or ABOUT; "" for none. keys: returns
    the text of KEYS.
    """

    def __init__(self, keys: Callable[[], str]) -> None:
        self.shown = ""
        self._keys = keys
        self._texts: dict[str, str] = {}
        self._titles: dict[str, str] = {}
        self._pictures: dict[str, moderngl.Texture] = {}
        self._context: moderngl.Context | None = None
        self._is_new = False

    def begin(self, context: moderngl.Context) -> None:
        """Prepare the pictures. Call once, when there is a context."""
        self._context = context

    def end(self) -> None:
        """Release the pictures. Call once, before the context is destroyed."""
        for texture in self._pictures.values():
            texture.release()
        self._pictures.clear()

    def open(self, name: str) -> None:
        """Show a document."""
        if not self._texts:
            self._begin_markdown()
        self.shown, self._is_new = name, True

    def draw(self) -> None:
        """Draw the open document with the list of all, in a box over the window."""
        if not self.shown:
            return
        viewport, em, flags = imgui.get_main_viewport(), imgui.get_font_size(), imgui.WindowFlags_
        room = viewport.work_size * 0.96
        size = ImVec2(min(WIDTH_EM * em, room.x), min(HEIGHT_EM * em, room.y))
        imgui.set_next_window_pos(viewport.get_center(), imgui.Cond_.always, (0.5, 0.5))
        imgui.set_next_window_size(size)
        imgui.push_style_color(imgui.Col_.window_bg, theme.POPUP)
        fixed = flags.no_docking | flags.no_collapse | flags.no_saved_settings | flags.no_resize
        opened, still_open = imgui.begin(NAME, True, fixed)
        imgui.pop_style_color()
        if opened:
            imgui.begin_child("##documents", (LIST_EM * em, 0))
            for name, title in self._titles.items():
                if imgui.selectable(title, name == self.shown)[0]:
                    self.open(name)
            imgui.end_child()
            imgui.same_line()
            imgui.begin_child("##document", (0, 0))
            if self._is_new:
                imgui.set_scroll_y(0)
                self._is_new = False
            if self.shown == GETTING_STARTED:
                self._tiles()
            else:
                imgui_md.render(self._texts[self.shown])
            imgui.end_child()
        imgui.end()
        if not still_open:
            self.shown = ""

    def _tiles(self) -> None:
        """Draw the first steps for a new user, each with a picture."""
        if imgui.begin_table("tiles", COLUMNS, imgui.TableFlags_.sizing_stretch_same):
            for name, text in TILES.items():
                imgui.table_next_column()
                if picture := self._picture(name):
                    imgui.image(imgui.ImTextureRef(picture.texture_id), picture.size)
                wrapped(text)
                imgui.spacing()
            imgui.end_table()
        wrapped(MORE)

    def _begin_markdown(self) -> None:
        texts = {path.name: path.read_text(encoding="utf-8") for path in folder().glob("*.md")}
        titles = {name: text.partition("\n")[0].lstrip("# ") for name, text in texts.items()}
        order = sorted(texts, key=lambda name: (name != FIRST, titles[name]))
        self._texts = texts | {KEYS: self._keys(), ABOUT: self._about()}
        names = GETTING_STARTED, KEYS, *order, ABOUT
        self._titles = {name: titles.get(name, name) for name in names}
        options = imgui_md.MarkdownOptions()
        options.callbacks.on_open_link = self.follow
        options.callbacks.on_image = self._picture
        imgui_md.initialize_markdown(options)

    def _about(self) -> str:
        opengl = self._context.info if self._context is not None else {}
        return (
            f"# Lucida {lucida.__version__}\n\nOne camera, two renderers. MIT licence.\n\n"
            f"- Python {platform.python_version()}, Dear ImGui {imgui.get_version()}\n"
            f"- OpenGL: {opengl.get('GL_VERSION', '')}\n- {opengl.get('GL_RENDERER', '')}\n\n"
            "`lucida doctor` says what works here, and what to install for the rest."
        )

    def follow(self, address: str) -> None:
        """Open a link: another document, or an address."""
        name = address.partition("#")[0]
        if name in self._texts:
            self.open(name)
        elif address.startswith(("https:", "http:")):
            webbrowser.open(address)

    def _picture(self, name: str) -> imgui_md.MarkdownImage | None:
        """Return a document's picture at its own width, or narrower to fit."""
        texture = self._pictures.get(name) or self._load(name)
        if texture is None:
            return None
        image = imgui_md.MarkdownImage()
        width = min(float(texture.width), imgui.get_content_region_avail().x)
        image.texture_id = texture.glo
        image.size = ImVec2(width, width * texture.height / texture.width)
        image.uv1, image.col_tint = ImVec2(1, 1), theme.rgb("#ffffff")
        return image

    def _load(self, name: str) -> moderngl.Texture | None:
        from PIL import Image

        path = folder() / name
        if self._context is None or not path.is_file() or path.suffix == ".svg":
            return None
        pixels = np.asarray(Image.open(path).convert("RGB"))
        texture = self._context.texture(pixels.shape[1::-1], 3, pixels.tobytes(), alignment=1)
        texture.build_mipmaps()
        texture.filter = moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR
        self._pictures[name] = texture
        return texture
