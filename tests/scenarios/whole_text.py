"""No text is cut off: in every layout, view and box, in small windows with large type."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from cut_texts import cut_texts
from imgui_bundle import hello_imgui, imgui
from views_in_turn import views_in_turn
from window_driver import SIZE, Driver, Key

from app.detective import example
from app.detective.readings import Convention
from app.host import layout
from app.results.model import ClassAnswer, NamedMistake, class_results
from app.results.view import ResultsView
from app.state.app_state import AppState
from app.storage.paths import stored

CASES = (((1024, 768), 1.5), ((1024, 768), 2.0), ((1280, 720), 2.0), ((1080, 1920), 2.0))
MENUS = ("File", "Edit", "Scene", "Camera", "Image", "View", "Lecture", "Help")
MATRIX = Convention("world-to-camera", True, "OpenCV", turned=True)
CODE = """\
def viewing_ray(i, j, width, height, camera):
    x = camera.left + j / width * (camera.right - camera.left)
    y = camera.top - i / height * (camera.top - camera.bottom)
    d = camera.distance
    return camera.eye, [x * a + y * b - d * c for a, b, c in zip(camera.u, camera.v, camera.w)]
"""


def with_content(d: Driver) -> AppState:
    """Return a state in which every view has something to show; fill those that keep it apart."""
    path = d.folder / "rays.py"
    path.write_text(CODE)
    mistake = NamedMistake("rows count upwards", "Rows count downwards, **v** points up.", "Light")
    answers = [
        ClassAnswer(f"{n}", "Exercise: a pixel's ray", n > 2, None, (mistake,)) for n in range(5)
    ]
    results = class_results(
        answers, ["Light", "Exercise: a pixel's ray"], ["a.jsonl:3: is no JSON"]
    )
    d.window.view(ResultsView).give(results, None, path)  # type: ignore[arg-type]
    text = example.printed_matrix(example.matrix_of(d.window.state.camera, MATRIX, "y"))
    return d.window.state.with_options(
        marked=(60, 80),
        objects={"chosen": (2,)},
        probe={"pins": ((10, 20), (300, 400))},
        detective={"text": text},
        your_code={"file": stored(str(path))},
    )


def boxes(d: Driver) -> Iterator[str]:
    """Open every box in turn."""
    shell, files = d.window.shell, d.window.files
    shell.toggle_palette()
    d.ctx.yield_(4)
    yield "palette"
    d.press(int(Key.escape))
    shell.toggle_help()
    d.ctx.yield_(4)
    yield "shortcut sheet"
    d.press(int(Key.escape))
    d.press(int(Key.mod_ctrl) | int(Key.g))
    d.ctx.yield_(3)
    yield "go to pixel"
    d.press(int(Key.escape))
    d.window.ask_resolution()
    d.ctx.yield_(4)
    yield "resolution"
    d.press(int(Key.escape))
    d.press(int(Key.mod_ctrl) | int(Key.o))
    d.ctx.yield_(4)
    yield "file dialog"
    d.press(int(Key.escape))
    d.press(int(Key.mod_ctrl) | int(Key.mod_shift) | int(Key.s))
    d.ctx.yield_(4)
    yield "save dialog"
    d.press(int(Key.escape))
    files.ask(
        "house.obj: add the model to the scene? Later ones go the same way.",
        {"Add it to the scene": lambda: None, "Open it instead": lambda: None},
    )
    d.ctx.yield_(4)
    yield "question"
    d.press(int(Key.escape))
    files.message = "my-lecture.toml:34: steps[3].options.images.channel: 'depht' is unknown; " * 2
    d.ctx.yield_(4)
    yield "message"
    files.message = ""
    for menu in MENUS:
        d.ctx.item_click(f"//##MainMenuBar/{menu}")
        d.ctx.yield_(4)
        yield f"menu {menu}"
        d.press(int(Key.escape))
    d.ctx.yield_(2)


@contextmanager
def looked_at(d: Driver, found: list[Any]) -> Iterator[Any]:
    """Notes what is cut in a frame, and tooltips that would be."""
    set_item_tooltip, wide = imgui.set_item_tooltip, dict[str, str]()

    def told(text: str) -> None:
        set_item_tooltip(text)
        room = imgui.get_io().display_size.x - 2 * imgui.get_style().window_padding.x
        if imgui.calc_text_size(text).x > room:
            wide["tooltip"] = text

    def look(name: str) -> None:
        seen: list[dict[str, str]] = []

        def drawn(target: Any) -> None:
            if not d.window.is_rearranging():
                seen.append(cut_texts() | wide)
                if os.environ.get("SWEEP_OUT") and seen[-1]:
                    from PIL import Image

                    key = name.replace(" ", "_").replace("/", "_")
                    Image.fromarray(target.read()).save(
                        f"{os.environ['SWEEP_OUT']}/{key}.png", compress_level=1
                    )

        wide.clear()
        d.run.on_drawn = drawn
        d.until(lambda: bool(seen))
        d.run.on_drawn = None
        if seen[-1]:
            found.append((name, seen[-1]))
            print("CUT", name, seen[-1], flush=True)

    imgui.set_item_tooltip = told
    try:
        yield look
    finally:
        imgui.set_item_tooltip = set_item_tooltip


def drive_nothing_is_cut_off(d: Driver) -> None:
    cut: list[Any] = []
    stage = d.window.shell.stage
    state = with_content(d)
    d.window.change(state)
    d.settle()
    cases = CASES
    if os.environ.get("SWEEP") == "all":
        cases = tuple(
            (s, f)
            for s in ((1024, 768), (1280, 720), (1280, 1024), (1920, 1080), (1080, 1920))
            for f in (1.0, 1.5, 2.0)
        )
    elif os.environ.get("SWEEP"):
        cases = CASES[int(os.environ["SWEEP"]) :][:1]
    with looked_at(d, cut) as look:
        for size, scale in cases:
            hello_imgui.change_window_size(size)
            d.window.change(d.window.state.with_options(preferences={"font_scale": scale}))
            d.ctx.yield_(6)
            of = f"{size[0]}x{size[1]} {scale}"
            for one in layout.LAYOUTS:
                if one.name != layout.LECTURE:
                    layout.switch(one.name)
                    d.ctx.yield_(6)
                    d.until(lambda: all(view.settled for view in stage.shown))
                    d.ctx.yield_(2)
                    look(f"{of} layout {one.name}")
            layout.switch(layout.LAYOUTS[0].name)
            d.ctx.yield_(8)
            for name in boxes(d):
                look(f"{of} {name}")
            shown = {view.name for view in stage.shown}
            for name in views_in_turn(d):
                look(f"{of} view {name}")
            for name in stage.views:
                stage.show(name, name in shown)
    hello_imgui.change_window_size(SIZE)
    d.ctx.yield_(4)
    assert not cut, cut
