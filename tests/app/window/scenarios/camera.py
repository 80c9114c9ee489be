"""The camera panel: numbers dragged and typed."""

from window_driver import Key, changed


def drive_a_slider_is_dragged(d):
    before = d.agreeing_images()
    center = d.box(d.field("w.x")).get_center()
    d.ctx.mouse_teleport_to_pos((center.x, center.y))
    d.ctx.mouse_down(0)
    for step in range(1, 5):
        d.ctx.mouse_teleport_to_pos((center.x + 14 * step, center.y))
        image = d.renderers.ray_image
        assert image is not None  # never nothing
        assert d.renderers.ray_error is None
    d.ctx.mouse_up(0)
    assert d.state.camera.w[0] > d.start.camera.w[0] + 0.05
    after = d.agreeing_images()
    assert changed(before[0], after[0]) > 0.1
    assert changed(before[1], after[1]) > 0.1
    assert d.steps == 1  # the whole drag
    assert d.renderers.ray_image.factor == 1


BACK = "//Camera/Back to the camera shown"


def drive_a_number_that_is_not_legal_moves_nothing(d):
    """The buttons stay where they are, and one of them is a way out."""
    names = ("Scene's view", "Canonical", "Look at", "##eye.x", "##distance")

    def places():
        boxes = (d.box(f"//Camera/{name}") for name in names)
        return [(box.min.x, box.min.y) for box in boxes]

    before = places()
    d.type("left", "9")  # and right is smaller
    panel = d.window.views["Camera"]
    assert panel.has_pending
    d.frames(2)
    assert places() == before
    d.click("//Camera/Canonical")
    assert not panel.has_pending
    assert d.state.camera.eye == (0, 0, 0)
    d.type("left", "9")
    assert panel.has_pending
    d.click("//Camera/Canonical")  # where the camera is already
    d.frames(2)
    assert not panel.has_pending


def drive_a_singular_basis_is_told_and_survived(d):
    d.show_small()
    d.press(Key.o)
    assert not d.state.keep_orthonormal
    d.settle()
    legal, before = d.state, d.images()
    for name in ("u", "v", "w"):
        d.type(f"{name}.z", "0")
    draft = d.window.views["Camera"].draft
    assert draft.error is not None
    assert draft.error.field == "w"
    assert "lies in the plane" in str(draft.error)  # the longest
    assert d.state.camera.w[2] == legal.camera.w[2]  # only the legal steps were taken
    assert d.ctx.item_exists(BACK)
    d.settle()
    assert d.ctx.get_window_by_ref("//Camera").scroll_max.y == 0
    raster, ray = d.images()
    assert raster.std() > 5
    assert changed(raster, ray) < 0.002
    d.type("distance", "-1")
    assert d.state.camera.distance == legal.camera.distance
    d.click(BACK)
    assert d.window.views["Camera"].draft.error is None
    assert d.window.views["Camera"].draft.camera == d.state.camera
    while d.state != legal and d.window.can_undo():
        d.undo()
    d.settle()
    assert d.state == legal
    assert changed(before[0], d.images()[0]) == 0


def drive_letters_typed_into_a_field_are_no_shortcuts(d):
    d.ctx.item_double_click(d.field("eye.y"))
    d.ctx.key_chars_replace("po")
    d.press(Key.p)
    d.press(Key.escape)
    assert d.state == d.start
