"""Everything by keys alone: Tab reaches every control, a frame shows where, Alt opens the menus."""

import numpy as np
from imgui_bundle import imgui
from views_in_turn import PAGES, views_in_turn, with_content
from window_driver import FRAME_S, Key

from lucida.app.ui import theme
from lucida.app.window.menu_keys import BAR

STEPS_BACK = 4  # to controls where Tab was before, one after another: it is round
ALT, CTRL, SHIFT = (key for key in (Key.mod_alt, Key.mod_ctrl, Key.mod_shift))
OTHERS = int(imgui.ItemFlags_.disabled)
Box = tuple[int, int, int, int]  # left, top, right, bottom


def controls(d):
    """Return the visible controls of the view in use, by their ids. ImGui counts inner windows
    among a window's items, and ImPlot its axes, without flags."""
    context, found = imgui.get_current_context(), imgui.test_engine.TestItemList()
    d.ctx.gather_items(found, f"//{context.nav_window.root_window.name}")
    inner = {window.child_id for window in context.windows}
    items = {}
    for number in range(found.get_size()):
        item, box = found.get_by_index(number), found.get_by_index(number).rect_clipped
        is_one = item.item_flags and not item.item_flags & OTHERS and item.id_ not in inner
        if is_one and min(box.get_width(), box.get_height()) > 1:
            items[item.id_] = (int(box.min.x), int(box.min.y), int(box.max.x), int(box.max.y))
    return items


def unreached(d, ids):
    """Return the ids that Tab, held, does not go to until it finds nothing new."""
    context, seen, old = imgui.get_current_context(), set[int](), 0
    d.ctx.key_down(Key.tab)
    while ids - seen and old < STEPS_BACK:
        d.frames()
        old = old + 1 if context.nav_id in seen else 0
        seen.add(context.nav_id)
    d.ctx.key_up(Key.tab)
    return ids - seen


def drive_tab_reaches_every_control(d):
    d.window.change(with_content(d))
    missed, io = {}, imgui.get_io()
    d.ctx.window_focus("//Camera")  # a view that is shown already gets no focus
    io.key_repeat_delay = io.key_repeat_rate = FRAME_S / 2  # a step a frame
    for name in views_in_turn(d, PAGES[:1]):
        items = controls(d)
        if left := unreached(d, items.keys()):
            missed[name] = [items[one] for one in left]
    assert not missed, missed


def drive_a_frame_shows_where_the_keyboard_is(d):
    for look in ("dark", "light"):
        d.change(preferences={"theme": look})
        d.ctx.nav_move_to(d.field("eye.x"))
        box = d.ctx.item_info(d.field("eye.x")).rect_clipped
        left, top, right = int(box.min.x), int(box.min.y), int(box.max.x)
        rows = d.picture()[top - 6 : top + 1, left + 8 : right - 8].astype(int)
        ray = np.round(255 * np.array([*theme.RAY][:3]))
        assert (np.abs(rows - ray).max(axis=2) < 30).all(axis=1).sum() >= 2, look
        assert (rows.max(axis=2) < 60).all(axis=1).sum() >= 2, look


def drive_alt_leads_into_the_menus_and_back(d):
    context, menus = imgui.get_current_context(), d.window.menu_keys

    def at():
        d.frames(2)
        return context.nav_window.name if context.nav_window else ""

    d.ctx.mouse_teleport_to_pos(d.point("Raster", 0.5, 0.5))
    imgui.set_window_focus(None)
    d.press(Key.f10)
    d.press(Key.escape)
    assert at() == ""
    d.press(Key.tab)
    before = at(), context.nav_id
    for key in (Key.left_alt, Key.f10):
        d.press(key)
        assert at() == BAR
        d.press(Key.right_arrow)
        d.press(Key.down_arrow)
        assert at() == "Edit###Menu_00"
        d.press(Key.left_arrow)
        assert at() == "File###Menu_00"
        d.press(Key.escape)
        assert (at(), context.nav_id) == before, (key, at(), context.nav_id, before)
    d.press(Key.f10)
    d.press(Key.down_arrow)
    d.press(Key.enter)  # Open...
    d.frames(5)
    assert d.files.dialog.is_open
    d.press(Key.escape)
    assert (at(), context.nav_id) == before, (at(), context.nav_id, before)
    assert d.state.marked is None  # the arrows were the menus', not the image's
    # Alt with a letter or the mouse is no way into the menus.
    d.press(ALT | Key.l)
    assert (at(), context.nav_id) == before, (at(), context.nav_id, before)
    d.ctx.key_down(Key.left_alt)
    d.drag(d.point("Raster", 0.4, 0.5), d.point("Raster", 0.5, 0.5))
    d.ctx.key_up(Key.left_alt)
    assert at() != BAR
    assert not menus.in_menus


def drive_the_first_tab_goes_into_a_view(d):
    imgui.set_window_focus(None)
    d.frames(2)
    d.press(Key.tab)
    assert d.stage.keyboard
    assert imgui.get_current_context().nav_id
