"""The camera panel beyond its plain numbers: what is coupled, presets, lenses, passages."""

from imgui_bundle import imgui
from window_driver import Key, changed

from lucida.app.cameras.lens_choices import LENS_PRESETS
from lucida.renderer.camera.lenses import Lens


def open_section(d, name):
    d.ctx.item_open(f"//Camera/{name}")
    d.frames()


def close_sections(d):
    d.window.views["Camera"].open_sections(())
    d.frames()


def right_click_menu(d, field, entry):
    d.click(d.field(field), imgui.MouseButton_.right)
    d.click(f"//$FOCUSED/{entry}")


def drive_all_of_the_main_part_is_seen_without_scrolling(d):
    d.resize((1280, 720))
    close_sections(d)
    panel = d.ctx.get_window_by_ref("//Camera")
    for scale in (1.5, 1.0):
        d.change(preferences={"font_scale": scale})
        d.frames(4)
        assert panel.scroll_max.y == 0
        assert d.box("//Camera/Look at").max.y < panel.rect().max.y
    open_section(d, "More")
    d.frames(2)
    assert panel.scroll_max.y == 0
    close_sections(d)


def drive_the_field_of_view_is_typed(d):
    d.show_small()
    before = d.agreeing_images()
    was = d.state.camera
    d.type("field of view", "35")
    camera = d.state.camera
    assert abs(d.renderers.camera(d.state).fov_y_deg - 35) < 1e-4
    assert camera.viewport == was.viewport
    assert camera.distance > was.distance
    assert changed(before[0], d.agreeing_images()[0]) > 0.1
    d.type("field of view", "200")
    assert "between 0 and 180" in str(d.window.views["Camera"].draft.error)
    assert d.state.camera == camera
    d.click("//Camera/Back to the camera shown")


def drive_a_step_shows_parts_of_the_panel(d):
    d.change(camera={"shown": ("eye", "Lens")})
    d.frames(3)
    items = d.field("eye.x"), d.field("lens model"), d.field("u.x"), "//Camera/Look at"
    assert [d.ctx.item_exists(one) for one in items] == [True, True, False, False]


def drive_near_and_far_are_switched_on_and_cut(d):
    close_sections(d)
    open_section(d, "More")
    d.show_small()
    before = d.agreeing_images()
    assert (d.state.camera.near, d.state.camera.far) == (None, None)
    d.click("//Camera/near")
    d.click("//Camera/far")
    camera = d.state.camera
    assert camera.near is not None
    assert camera.far is not None
    assert changed(before[0], d.agreeing_images()[0]) < 0.002  # fitted: nothing is cut off
    d.type("near plane", "9")
    d.type("far plane", "11")
    after = d.agreeing_images()
    assert changed(before[0], after[0]) > 0.05
    assert changed(before[1], after[1]) > 0.05
    d.click("//Camera/near")
    d.click("//Camera/far")
    assert d.state.camera == d.start.camera
    close_sections(d)


def drive_a_number_is_reset(d):
    d.type("eye.x", "-2.5")
    right_click_menu(d, "eye.x", "###reset")
    assert d.state.camera.eye[0] == d.start.camera.eye[0]
    assert d.steps == 2


def drive_presets_frame_the_scene_in_both_images(d):
    d.show_small()
    d.menu("Camera/Presets/Cabinet")
    d.agreeing_images()


def drive_a_lens_is_chosen_dragged_and_taken_off(d):
    close_sections(d)
    open_section(d, "Lens")
    before = d.images()
    d.menu("Camera/Lens/Barrel")
    barrel = d.state.camera
    assert barrel.lens == LENS_PRESETS[0].lens
    assert changed(before[0], d.agreeing_images()[0]) > 0.1
    past = d.steps
    d.drag_field("lens.k1", 60)
    dragged = d.state.camera.lens
    assert dragged.coefficient("k1") > -0.2
    assert dragged.coefficient("k2") == 0.06
    assert d.steps == past + 1
    right_click_menu(d, "lens.k1", "###reset")
    assert d.state.camera.lens == Lens("brown", {"k2": 0.06})
    d.click("//Camera/##lens model")
    d.click("//$FOCUSED/Wide-angle lens (FOV)")
    assert d.state.camera.lens == Lens("fov", {"omega": 1.0})
    d.type("lens.omega", "4")
    assert "not between 0 and pi" in str(d.window.views["Camera"].draft.error)
    d.click("//Camera/Back to the camera shown")
    d.press(Key.p)
    assert d.state.camera.is_parallel
    assert d.state.camera.lens is None
    assert any("The lens is off" in text for text in d.window.shell.toasts.texts)
    d.undo()
    d.menu("Camera/Lens/No lens")
    camera = d.state.camera
    assert (camera.lens, camera.distance) == (None, d.start.camera.distance)
    close_sections(d)


def drive_outside_of_a_lens_is_said_and_straight_lines_bend(d):
    d.menu("Camera/Lens/190 degrees")
    d.agreeing_images()
    window = d.window
    assert window.renderers.seen_at(window.state, (1, 1)) == "outside of the lens"
    d.menu("Image/Straight lines")
    assert window.state.options.pair.straight_lines
    d.frames(2)
    d.press(Key.mod_alt | Key._2)
    d.agreeing_images()


def drive_sections_stay_as_the_user_leaves_them(d):
    view, stage = d.window.views["Camera"], d.stage
    close_sections(d)
    open_section(d, "Look at")
    assert view.sections == ("Look at",)
    left = stage.arrangement()
    assert left.sections["Camera"] == ("Look at",)
    close_sections(d)
    assert view.sections == ()
    view.open_sections(left.sections["Camera"])  # as a session does
    d.until(lambda: d.ctx.item_exists("//Camera/##look.up.x"))
    assert view.sections == ("Look at",)
    close_sections(d)
