"""The box of File > Export figure, with the figure's content, size, background and preview."""

from __future__ import annotations

import contextlib
from dataclasses import replace
from typing import Any, get_args

import moderngl
import numpy as np
from imgui_bundle import ImVec2, imgui
from PIL import Image

from lucida.app.state.bounds import range_of
from lucida.app.ui import theme
from lucida.app.ui.host import Host
from lucida.app.ui.uploads import Uploads
from lucida.renderer.images.frame import check_size
from lucida.renderer.system.atomic import atomic_write, file_stem
from lucida.renderer.system.errors import LucidaError, describe
from lucida.renderer.system.memo import same

from .figure_choice import ENDINGS, FigureChoice, Ground, What, check_ending
from .figures import encoder, figure_of, painted

TITLE, PREVIEW_EM = "Export figure", 22.0
GRAY = 128  # behind transparent pixels
NAMES: dict[What, str] = {
    "outside": "Outside view",
    "raster": "Raster image",
    "ray": "Ray image",
    "pair": "Both images",
    "probe": "Probe",
}


class FigureBox:
    """The box of a figure. choice: the figure. focused: see Box."""

    def __init__(self, host: Host, choice: FigureChoice) -> None:
        self._host, self.choice = host, choice
        self.focused = True
        self._uploads = Uploads(moderngl.get_context())
        self._shown: Any = None
        self._problem = ""

    def draw(self) -> bool:
        """Draw the box. Return True while it stays open."""
        center, flags = imgui.get_main_viewport().get_center(), imgui.WindowFlags_
        imgui.set_next_window_pos(center, imgui.Cond_.always, ImVec2(0.5, 0.5))
        kind = flags.no_docking | flags.always_auto_resize | flags.no_collapse
        _, stays = imgui.begin(TITLE, True, kind | flags.no_saved_settings)
        self.focused = imgui.is_window_focused()
        stays = bool(stays) and not (self.focused and imgui.is_key_pressed(imgui.Key.escape))
        self._choose()
        self._preview()
        imgui.begin_disabled(bool(self._problem))
        if imgui.button("Save...") and not self._problem:
            self._save()
            stays = False
        imgui.end_disabled()
        imgui.same_line()
        stays = not imgui.button("Cancel") and stays
        imgui.end()
        if not stays:
            self._uploads.release()
        return stays

    def _choose(self) -> None:
        em, one = imgui.get_font_size(), self.choice
        imgui.set_next_item_width(10 * em)
        kinds = get_args(What)
        changed, number = imgui.combo(
            "subject", kinds.index(one.what), [NAMES[kind] for kind in kinds]
        )
        if changed:
            one = replace(one, what=kinds[number])
        imgui.set_next_item_width(10 * em)
        changed, size = imgui.input_int2("width, height in pixels", [*one.size])
        if changed:
            with contextlib.suppress(LucidaError):  # while it is typed
                one = replace(one, size=check_size((size[0], size[1])))
        imgui.set_next_item_width(10 * em)
        limits, flags = range_of(FigureChoice, "scale"), imgui.SliderFlags_.logarithmic
        changed, scale = imgui.slider_float(
            "scale of lines and letters", one.scale, *limits, "%.2f", flags
        )
        if changed:
            one = replace(one, scale=scale)
        for ground in get_args(Ground):
            if imgui.radio_button(
                "as shown" if ground == "shown" else ground, one.ground == ground
            ):
                one = replace(one, ground=ground)
            imgui.same_line()
        imgui.text("ground")
        self.choice = one

    def _preview(self) -> None:
        """Draw the figure, reduced, over gray so that transparent parts are visible."""
        em = imgui.get_font_size()
        share = PREVIEW_EM * em / max(self.choice.size)
        width, height = (max(1, round(share * side)) for side in self.choice.size)
        host, scale = self._host, share * self.choice.scale
        small = replace(self.choice, size=(width, height), scale=scale)
        self._uploads.begin_frame()
        key = small, host.state, theme.used(), host.renderers.busy
        if not same(key, self._shown):
            self._shown = key
            try:
                shown = Image.new("RGBA", small.size, (*3 * (GRAY,), 255))
                shown.alpha_composite(painted(figure_of(host, small)))
                self._uploads.put("preview", np.asarray(shown.convert("RGB")))
                self._problem = ""
            except (LucidaError, moderngl.Error) as error:
                self._problem = describe(error)
        texture = self._uploads.get("preview")
        if self._problem or texture is None:
            imgui.text_colored(theme.ERROR, self._problem)
        else:
            imgui.image(imgui.ImTextureRef(texture.glo), ImVec2(width, height))

    def _save(self) -> None:
        host, choice = self._host, self.choice
        endings = (*ENDINGS, ".tex") if choice.what == "probe" else ENDINGS
        name = f"{file_stem(host.state.scene.name) or 'scene'}-{choice.what}{endings[0]}"
        try:
            content = encoder(host, choice)
        except (LucidaError, moderngl.Error) as error:
            host.files.message = describe(error)
            return

        def store(path: str) -> str:
            written = content(check_ending(path))
            with atomic_write(path) as file:
                file.write(written)
            return f"Saved {path}, {len(written)} bytes."

        host.files.save_as_dialog("Export the figure", name, ("Figures", *endings), store)


def ask_figure(host: Host) -> None:
    """Open the box, with the outside view selected."""
    host.box = FigureBox(host, FigureChoice())
