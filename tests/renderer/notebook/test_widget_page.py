"""The widget's JavaScript in Chromium: a plain page whose model hands on to a real widget."""

import base64
import io
import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from waiting import wait_for

from lucida import picture
from lucida.renderer.notebook import explore

pytestmark = pytest.mark.filterwarnings("ignore")  # Playwright's own
SIZE = (80, 60)
PAGE = """<!doctype html><style>%(css)s</style><div id="place"></div><script type="module">
const url = URL.createObjectURL(new Blob([%(js)s], { type: "text/javascript" }));
const { default: widget } = await import(url);
const heard = {};
const send = async (message) => {
  for (const [told, data] of await say(message)) {
    const bytes = Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));
    heard["msg:custom"](told, [new DataView(bytes.buffer)]);
  }
};
const on = (name, heardBy) => (heard[name] = heardBy);
const model = { get: () => %(size)s, send, on, off: () => {} };
widget.render({ model, el: document.getElementById("place") });
</script>"""


@pytest.fixture(scope="module")
def page(browser):
    """A page that shows a widget, for all tests; page.widget is that."""
    widget = explore("spheres", size=SIZE)
    folder = Path(explore.__code__.co_filename).parent
    parts = {"css": (folder / "explore.css").read_text("utf-8"), "size": json.dumps(SIZE)}
    parts["js"] = json.dumps((folder / "explore.js").read_text("utf-8"))
    page = browser.new_page()
    answers = []

    def send(told, data=()):
        answers.append((told, base64.b64encode(b"".join(data)).decode()))

    def say(message):
        answers.clear()
        if page.is_busy:
            page.unanswered += 1
            return []
        data = {"method": "custom", "content": message}
        widget.comm.handle_msg({"content": {"data": data}, "buffers": []})
        return answers

    widget.send = send
    page.expose_function("say", say)
    page.widget, page.errors, page.is_busy, page.unanswered = widget, [], False, 0
    page.on("pageerror", lambda error: page.errors.append(error))
    page.set_content(PAGE % parts)
    shown(page, bool)
    yield page
    page.close()
    assert not page.errors


def shown(page, is_awaited):
    """Wait until the camera is the awaited one, and the canvas shows its full image."""

    def look():
        data = page.locator("canvas").evaluate("canvas => canvas.toDataURL().split(',')[1]")
        if not is_awaited(page.widget.camera):
            return False
        image = np.asarray(Image.open(io.BytesIO(base64.b64decode(data))))
        return np.array_equal(image[..., :3], picture(page.widget.frame))

    wait_for(look)


def test_mouse_keys_and_numbers_move_the_camera(page):
    widget, canvas = page.widget, page.locator("canvas")
    first, box = widget.camera, canvas.bounding_box()
    x, y = box["x"] + 40, box["y"] + 30
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 20, y + 5, steps=5)
    page.mouse.up()
    shown(page, lambda camera: camera != first)
    assert widget.camera.distance == first.distance and widget.pixel is None
    eye = widget.camera.eye
    page.mouse.wheel(0, -100)
    shown(page, lambda camera: camera.eye != eye)
    canvas.press("Home")
    shown(page, lambda camera: camera == first)
    number = page.get_by_label("field of view").last
    number.fill("60")
    number.press("Enter")
    shown(page, lambda camera: camera.fov_y_deg == pytest.approx(60))
    number.fill("200")
    number.press("Enter")
    page.get_by_role("alert").get_by_text("200 is not between 0 and 180").wait_for()
    page.get_by_label("eye x").first.fill("900")  # thousandths of the slider's range
    shown(page, lambda camera: camera.eye[0] > 5)
    page.get_by_label("projection").select_option("parallel")
    shown(page, lambda camera: camera.is_parallel)
    page.get_by_label("viewport height").last.wait_for()


def test_a_click_marks_a_pixel_and_shows_its_ray(page):
    def marked(pixel):
        page.get_by_text(f"row {pixel[0]}, column {pixel[1]} of 80x60").wait_for()
        assert page.widget.pixel == pixel

    page.locator("canvas").click(position={"x": 20.5, "y": 40.5})
    marked((40, 20))
    assert page.locator(".mark").is_visible()
    page.get_by_text("point = origin + t * direction").wait_for()
    page.locator("canvas").press("Enter")
    marked((29, 39))
    page.locator("canvas").press("Escape")
    page.locator(".mark").wait_for(state="hidden")
    page.locator(".hit:empty").wait_for(state="attached")
    assert page.widget.pixel is None


def test_nothing_piles_up_while_the_kernel_is_busy(page):
    page.is_busy = True
    page.mouse.move(40, 30)
    page.mouse.down()
    page.mouse.move(60, 40, steps=20)
    page.mouse.up()
    page.get_by_text("The kernel is busy.").wait_for()
    assert page.unanswered == 2
