"""The surroundings of the views: sheet, layouts, looks, bookmarks."""

import numpy as np
from imgui_bundle import ImVec2, imgui
from imgui_bundle.imgui.test_engine import TestAction
from window_driver import SIZE, Key

from lucida.app.images.pair.boxes import ask_resolution
from lucida.app.images.pair.view import RASTER
from lucida.app.ui import layout, theme
from lucida.app.window.documents import KEYS
from lucida.app.window.hints import Hints
from lucida.app.window.platform import begin_letters, lock_letters
from lucida.renderer.camera.navigation import orbited

CTRL, SHIFT = Key.mod_ctrl, Key.mod_shift


def into(d, name):
    """Shows a layout as it was made, and waits for it."""
    layout.switch(name)
    d.until(lambda: layout.current().name == name)
    layout.reset()
    d.frames(4)


def drive_the_sheet_fits_the_window_at_every_size_of_type(d):
    for scale in (1.0, 3.0):
        d.change(preferences={"font_scale": scale})
        d.press(SHIFT | Key.slash)
        assert d.window.shell.documents.shown == KEYS
        box = d.ctx.window_info("//Documentation").rect_full
        assert box.min.x >= 0 and box.max.x <= SIZE[0]
        assert box.min.y >= 0 and box.max.y <= SIZE[1]
        d.press(Key.escape)
        assert not d.window.shell.documents.shown


def drive_looks_are_options_that_undo_leaves_alone(d):
    dark = d.picture().mean()
    d.change(preferences={"theme": "light"})
    d.until(lambda: theme.PANEL.x > 0.9)
    assert d.picture().mean() > dark + 40
    height = imgui.get_font_size()
    d.press(CTRL | Key.equal)
    d.press(CTRL | Key.equal)
    assert d.state.preferences.font_scale == 1.5
    assert imgui.get_font_size() == 1.5 * height
    d.press(CTRL | Key._0)
    assert d.state.preferences.font_scale == 1.0
    for _ in range(3):
        d.press(CTRL | Key.minus)
    assert d.state.preferences.font_scale == 0.75
    assert not d.window.can_undo()


def drive_presentation_is_large_and_ends_with_escape(d):
    d.press(Key.f9)
    d.until(lambda: theme.LINE_WIDTH == 2.0)
    assert imgui.get_font_size() >= 0.02 * SIZE[1]
    d.press(Key.escape)
    d.until(lambda: theme.LINE_WIDTH == 1.0)
    assert d.state == d.start


def drive_layouts_have_keys_and_remember_the_users_changes(d):
    stage = d.stage
    into(d, layout.LAYOUTS[1].name)
    into(d, layout.LAYOUTS[0].name)
    for number, one in enumerate(layout.CHOICES):
        d.press(CTRL | (Key.f1 + number))
        d.until(lambda name=one.name: layout.current().name == name)
        d.frames(3)
        for name in one.places:
            if name in stage.views:
                assert stage.is_shown(name), (one.name, name)
    d.press(CTRL | Key.f2)
    d.until(lambda: layout.current().name == layout.LAYOUTS[1].name)
    stage.show(RASTER, False)
    d.frames(3)
    d.press(CTRL | Key.f1)
    d.until(lambda: layout.current().name == layout.LAYOUTS[0].name)
    d.frames(3)
    assert stage.is_shown(RASTER)
    layout.reset()


def drive_bookmarks_bring_views_back(d):
    d.ctx.mouse_teleport_to_pos(d.point(RASTER, 0.5, 0.5))
    home = d.state.view
    d.press(CTRL | Key._3)
    d.window.change(d.state.with_camera(orbited(d.state.camera, (0, 0, 0), 0.1, 0.0)))
    away = d.state.view
    assert away != home
    d.press(CTRL | Key._9)
    d.press(Key._3)
    d.until(lambda: d.state.view == home)
    d.press(Key._9)
    d.until(lambda: d.state.view == away)
    d.press(Key._5)
    assert "free" in d.window.shell.toasts.texts[-1]
    assert d.state.view == away
    d.undo()
    assert d.state.view == home


def drive_a_narrow_window_keeps_its_menus_and_its_status(d):
    d.change(preferences={"font_scale": 3.0})
    try:
        for width, names in ((900, ("File", "Help")), (300, ("Menu",))):
            d.resize((width, 480))
            for name in names:
                assert d.ctx.item_exists(f"//##MainMenuBar/##MenuBar/{name}"), (width, name)
            d.press(Key.f1)
            assert d.window.shell.documents.shown == KEYS
            d.frames(3)
            d.press(Key.escape)
            assert not d.window.shell.documents.shown
    finally:
        d.resize(SIZE)
    assert d.ctx.item_exists("//##MainMenuBar/##MenuBar/File")


def drive_a_framebuffer_out_of_scale_makes_no_letters(d):
    """As ImGui's backend finds it where the window is resized between two of its questions."""
    io, viewport = imgui.get_io(), imgui.get_main_viewport()
    far = ImVec2(1280, 720)
    lock_letters()
    io.display_framebuffer_scale = viewport.framebuffer_scale = far
    begin_letters()
    for found in (io.display_framebuffer_scale, viewport.framebuffer_scale):
        assert (found.x, found.y) == (1.0, 1.0)
    d.frames(2)
    d.resize((1, 1))
    d.resize(SIZE)
    d.agreeing_images()


def drive_documents_are_read_in_the_window(d):
    documents = d.window.shell.documents
    d.menu("Help/Getting started")
    d.settle()
    plain = d.picture()
    documents.end()  # without its pictures
    assert np.abs(d.picture().astype(int) - plain).max() == 0, "they are loaded again"
    documents.follow("cameras.md#lenses")
    d.picture()
    assert documents.shown == "cameras.md"
    d.press(Key.escape)
    assert not documents.shown


def drive_hints_are_shown_until_one_is_followed_and_never_again(d):
    shell, folder = d.window.shell, d.folder / "settings"
    d.settle()
    plain = d.picture()
    shell.hints = Hints(folder)
    d.frames(3)
    lower = d.picture()[SIZE[1] // 2 :].astype(int) - plain[SIZE[1] // 2 :]
    assert (np.abs(lower).max(axis=2) > 20).sum() > 1000, "they are over the images"
    d.press(Key.p)
    d.settle()
    assert not shell.hints.shown
    assert not Hints(folder).shown
    d.undo()
    shell.hints = Hints(None)
    d.settle()
    assert np.abs(d.picture().astype(int) - plain).mean() < 1


def drive_escape_ends_what_lies_on_top_before_it_takes_the_mark_away(d):
    window = d.window
    d.change(marked=(20, 30))
    d.ctx.menu_action(TestAction.hover, "//##MainMenuBar/Image/Resolution")
    any_popup = int(imgui.PopupFlags_.any_popup)
    assert imgui.is_popup_open("", any_popup)
    d.press(Key.escape)
    d.frames(10)
    assert not imgui.is_popup_open("", any_popup)
    assert window.state.marked == (20, 30)
    ask_resolution(window)
    d.frames(3)
    d.press(Key.escape)
    assert window.box is None
    assert window.state.marked == (20, 30)
    # A box behind the sheet.
    d.press(Key.f1)
    ask_resolution(window)
    d.frames(3)
    d.ctx.mouse_teleport_to_pos((SIZE[0] / 2, 0.25 * SIZE[1]))  # on the sheet, above the box
    d.frames(2)
    d.ctx.mouse_click(0)
    d.frames(2)
    assert window.shell.documents.shown
    d.press(Key.escape)
    assert not window.shell.documents.shown
    assert window.box is not None
    d.press(Key.escape)
    assert window.box is None
    assert window.state.marked == (20, 30)
    d.press(Key.escape)
    assert window.state.marked is None
