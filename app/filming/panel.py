"""The panel of the view "Film": the preview, its scrubber, the settings, the progress.

Takes values and returns requests.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

import moderngl
from imgui_bundle import ImVec2, imgui

from app.filming.model import PATHS
from app.filming.options import SAMPLES, FilmingOptions
from app.images.imaging import size_text
from app.state.bounds import range_of
from app.storage.paths import restored
from app.widgets import theme
from app.widgets.checks import checkbox, radio_button
from app.widgets.messages import wrapped
from app.widgets.rows import follow, row, tip
from app.widgets.sliders import slider_float, slider_int
from app.widgets.theme import Fonts
from renderer.camera import Size
from renderer.errors import one_line

Wish = Literal["", "open", "play", "save", "cancel"]
SIZES = ((640, 360), (1280, 720), (1920, 1080), (3840, 2160), (1080, 1080), (1080, 1920))
RATES = (12, 24, 25, 30, 50, 60)
FORMS = {".mp4": "MP4 (H.264)", ".gif": "GIF", ".webp": "WebP", "": "a folder of PNGs"}
TIMINGS = {"eased": "eased", "constant": "constant pace", "cut": "cut"}
PREVIEW_PART = 0.42  # of the view's height


@dataclass(frozen=True)
class Shown:
    """Hold what the panel shows beside the settings.

    problem: why there is no path. picture: the frame at the scrubber. number, count: of the frame.
    keys: of the path. progress: of the film that is made, its part and text; None if none is.
    """

    problem: str
    picture: moderngl.Texture | None
    number: int
    count: int
    keys: int
    playing: bool
    images: Size
    progress: tuple[float, str] | None


def panel(options: FilmingOptions, shown: Shown, fonts: Fonts) -> tuple[FilmingOptions, int, Wish]:
    """Draw the panel. Return the settings, the frame at the scrubber, and what was asked for."""
    number, wish = shown.number, ""
    if not shown.problem:
        _picture(shown)
        number, wish = _scrubber(shown)
    options, asked = _path(options, shown, fonts)
    imgui.separator()
    options = _settings(options, shown, fonts)
    return options, number, asked or _saving(options, shown) or wish  # type: ignore[return-value]


def _picture(shown: Shown) -> None:
    """Draw the frame as large as there is room for it."""
    room = imgui.get_content_region_avail()
    texture = shown.picture
    if texture is None:
        return
    width, height = texture.size
    scale = min(room.x / width, PREVIEW_PART * room.y / height)
    if scale > 0:
        imgui.image(imgui.ImTextureRef(texture.glo), ImVec2(scale * width, scale * height))


def _scrubber(shown: Shown) -> tuple[int, str]:
    name = "Pause" if shown.playing else "Play"
    wide = imgui.calc_text_size("Pause").x + 2 * imgui.get_style().frame_padding.x
    wish = "play" if imgui.button(f"{name}###play", ImVec2(wide, 0)) else ""
    imgui.same_line()
    imgui.set_next_item_width(-1)
    _, number = slider_int(
        "##frame", shown.number + 1, 1, max(shown.count, 2), f"%d of {shown.count}"
    )
    tip("The frame, and its camera in the outside view. Your own camera stays.")
    return min(number, shown.count) - 1, wish


def _path(options: FilmingOptions, shown: Shown, fonts: Fonts) -> tuple[FilmingOptions, str]:
    wish = ""
    imgui.set_next_item_width(row("path", "", "the way of the camera", fonts))
    titles = {name: title for name, (title, _) in PATHS.items()}
    options = _combo(options, "path", titles)
    told = PATHS[options.path][1]
    if shown.problem:
        wrapped(shown.problem, theme.legible(theme.MARK))
    else:
        keys = f" {shown.keys} key cameras." if shown.keys else ""
        wrapped(told + keys, theme.DIM)
    if options.path == "file":
        if imgui.button("Open key file..."):
            wish = "open"
        if options.file:
            name = one_line(Path(restored(options.file)).name)
            follow(imgui.calc_text_size(name).x)
            imgui.align_text_to_frame_padding()
            imgui.text(name)
    if options.path == "bookmarks":
        imgui.set_next_item_width(row("pace", "", "of the camera from key to key", fonts))
        options = _combo(options, "timing", TIMINGS)
    return options, wish


def _settings(options: FilmingOptions, shown: Shown, fonts: Fonts) -> FilmingOptions:
    imgui.set_next_item_width(row("length", "", "of the whole film", fonts))
    changed, seconds = slider_float(
        "##seconds", options.seconds, *range_of(FilmingOptions, "seconds"),
        "%.1f s",
        imgui.SliderFlags_.logarithmic | imgui.SliderFlags_.always_clamp,
    )  # fmt: skip
    options = replace(options, seconds=round(seconds, 1)) if changed else options
    imgui.set_next_item_width(row("rate", "", "frames a second", fonts))
    options = _combo(options, "fps", {rate: f"{rate} fps" for rate in RATES})
    imgui.set_next_item_width(
        row("size", "", "of each image, in pixels; the last one is that of the images now", fonts)
    )
    sizes = {size: size_text(size) for size in SIZES}
    if min(shown.images) > 0:
        even = shown.images[0] // 2 * 2, shown.images[1] // 2 * 2
        if min(even) > 0:
            sizes[even] = size_text(even)
    options = _combo(options, "size", sizes)
    row("images", "", "the renderer", fonts)
    for count, name in enumerate(("raster", "ray", "both")):
        if count:
            follow(imgui.calc_text_size(name).x + 1.5 * imgui.get_frame_height())
        if radio_button(f"{name}##renderer", options.renderer == name):
            options = replace(options, renderer=name)  # type: ignore[arg-type]
    if options.renderer != "raster":
        row("effects", "", "of the ray image", fonts)
        for name in ("shadows", "mirrors"):
            moved, on = checkbox(name, getattr(options, name))
            options = replace(options, **{name: on}) if moved else options  # type: ignore[arg-type]
            follow(imgui.calc_text_size("mirrors").x + 1.5 * imgui.get_frame_height())
        imgui.new_line()
    imgui.set_next_item_width(row("samples", "", "of the colour, per pixel", fonts))
    options = _combo(options, "samples", {count: str(count) for count in SAMPLES})
    imgui.set_next_item_width(row("file", "", "the kind of file", fonts))
    return _combo(options, "form", FORMS)


def _saving(options: FilmingOptions, shown: Shown) -> str:
    if shown.progress is not None:
        part, text = shown.progress
        width = -6 * imgui.get_font_size()
        imgui.progress_bar(part, ImVec2(width, 0), text)
        imgui.same_line()
        return "cancel" if imgui.button("Cancel", ImVec2(-1, 0)) else ""
    imgui.begin_disabled(bool(shown.problem))
    is_asked = imgui.button("Save film...", ImVec2(-1, 0))
    imgui.end_disabled()
    return "save" if is_asked else ""


def _combo(options: FilmingOptions, name: str, titles: Mapping[Any, str]) -> FilmingOptions:
    """Draw a choice among an option's values. Return the settings with it."""
    values: Sequence[Any] = list(titles)
    now = getattr(options, name)
    texts = list(titles.values())
    if now not in values:
        values = [*values, now]
        texts.append(size_text(now) if isinstance(now, tuple) else str(now))
    moved, number = imgui.combo(f"##{name}", values.index(now), texts)
    return replace(options, **{name: values[number]}) if moved else options
