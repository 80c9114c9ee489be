"""An image that shows nothing says so: over both images, in the status line, as the comparison."""

from dataclasses import replace

from imgui_bundle import imgui
from window_driver import RASTER, RAY

from lucida.app.cameras.remedies import CUT_NOTHING, FRAME
from lucida.app.images.pair import dark_note
from lucida.app.window.status import is_good_news, told

WHY = "everything is behind the eye"


def drive_an_empty_image_says_why(d):
    window = d.window
    x, y, z = window.state.camera.w
    eye = tuple(100.0 * part for part in window.state.camera.eye)
    away = replace(window.state.camera, w=(-x, -y, -z), eye=eye)
    window.change(window.state.with_camera(away))
    d.settle()
    reason = window.renderers.why_black(window.state)
    assert reason.text == WHY
    verdict = window.renderers.verdict(window.state)
    assert told(verdict, None) == f"nothing is hit in either image: {WHY}"
    assert is_good_news(verdict, None) is None
    for image in d.images():  # a box with text in the middle of a plain background
        height, width = image.shape[:2]
        middle = image[2 * height // 5 : 3 * height // 5, width // 3 : 2 * width // 3]
        assert middle.std(axis=(0, 1)).min() > 8
        assert image[: height // 4, width // 4 : width // 2].std(axis=(0, 1)).max() == 0
    window.undo()
    d.settle()
    assert window.renderers.why_black(window.state) is None
    assert {RASTER, RAY} <= set(window.shell.stage.rects)


def drive_a_black_image_has_a_button_that_helps(d):
    window = d.window
    before = window.state
    x, y, z = before.camera.w
    turned_away = replace(before.camera, w=(-x, -y, -z))
    cut_off = replace(before.camera, far=1e-3)
    for view, camera, remedy in ((RASTER, turned_away, FRAME), (RAY, cut_off, CUT_NOTHING)):
        window.change(before.with_camera(camera))
        d.settle()
        assert window.renderers.why_black(window.state) is not None
        d.click(f"//###{view}/**/{remedy}")
        d.settle()
        assert window.renderers.why_black(window.state) is None
        window.undo()
        assert window.state.camera == camera


def drive_the_note_on_a_scene_without_objects_needs_no_scrollbar(d):
    path = d.folder / "nothing.toml"
    path.write_text('lucida = 1\nname = "nothing"\nobjects = []\n')
    d.drop([str(path)])
    d.until(lambda: d.state.scene.name == "nothing")
    scrolls, wrapped = [], dark_note.wrapped

    def noting(*text):
        scrolls.append(imgui.get_scroll_max_y())
        wrapped(*text)

    for scale in (1.0, 1.1, 2.0):
        d.change(preferences={"font_scale": scale})
        d.settle()
        dark_note.wrapped = noting
        d.frames(3)
        dark_note.wrapped = wrapped
    assert scrolls and not any(scrolls)
