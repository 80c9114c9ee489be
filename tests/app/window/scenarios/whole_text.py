"""No text is cut off: in every layout, view and box, in small windows with large type."""

from contextlib import contextmanager
from itertools import chain

from cut_texts import cut_texts
from imgui_bundle import imgui
from imgui_bundle.imgui.test_engine import TestAction
from option_changes import with_options
from views_in_turn import views_in_turn, with_content
from window_driver import Key

from lucida.app.images.pair.boxes import ask_resolution
from lucida.app.ui import layout
from lucida.app.window.action_table import MENUS
from lucida.app.window.documents import KEYS

SIZE, LARGEST = (1024, 768), 2.0
CTRL, SHIFT, ESCAPE = (key for key in (Key.mod_ctrl, Key.mod_shift, Key.escape))


def boxes(d):
    """Open every box and menu in turn."""
    files, shell = d.files, d.window.shell
    answers = {"Add it to the scene": lambda: None, "Open it instead": lambda: None}
    opened = {
        "keys": lambda: shell.open_document(KEYS),
        "go to pixel": lambda: d.press(CTRL | Key.g),
        "resolution": lambda: ask_resolution(d.window),
        "open": lambda: d.press(CTRL | Key.o),
        "save": lambda: d.press(CTRL | SHIFT | Key.s),
        "question": lambda: files.ask("house.obj: add the model to the scene?", answers),
    }
    for menu in MENUS:  # all of them in one: the bar is too narrow
        path = f"//##MainMenuBar/Menu/{menu}"
        opened[menu] = lambda path=path: d.ctx.menu_action(TestAction.hover, path)
    for name, open_it in opened.items():
        open_it()
        d.frames(2)
        yield name
        if name not in MENUS:  # the next one takes its place
            d.press(ESCAPE)
    d.press(ESCAPE)
    files.message = "lecture.toml:34: steps[3].options.images.channel: 'depht' is unknown; " * 2
    d.frames(2)
    yield "message"
    files.message = ""


@contextmanager
def looking(d, cut):
    """Provide a function that notes what a frame cuts, and tooltips that would be cut."""
    set_item_tooltip, wide = imgui.set_item_tooltip, dict[str, str]()

    def with_tooltip(text):
        set_item_tooltip(text)
        room = imgui.get_io().display_size.x - 2 * imgui.get_style().window_padding.x
        if imgui.calc_text_size(text).x > room:
            wide["tooltip"] = text

    def look(name):
        wide.clear()
        if seen := d.in_draw_lists(lambda: cut_texts() | wide):
            cut[name] = seen

    imgui.set_item_tooltip = with_tooltip
    try:
        yield look
    finally:
        imgui.set_item_tooltip = set_item_tooltip


def layouts(d):
    """Show every layout of views in turn."""
    for one in layout.LAYOUTS:
        if one.name != layout.LECTURE:
            d.layout(one.name)
            d.until(lambda: all(view.settled for view in d.stage.shown))
            d.frames(3)  # ImGui sizes a view by its content of the last frame
            yield one.name


def drive_nothing_is_cut_off(d):
    cut = {}
    d.window.change(
        with_options(
            with_content(d), preferences={"font_scale": LARGEST}, images={"resolution": (120, 90)}
        )
    )
    with looking(d, cut) as look:
        d.resize(SIZE)
        for name in layouts(d):
            look(f"layout {name}")
        d.layout(layout.LAYOUTS[0].name)
        for name in chain(boxes(d), views_in_turn(d)):
            look(name)
    assert not cut, cut
