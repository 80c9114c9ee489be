"""The widget's JavaScript in Chromium: a plain page whose model hands on to a real widget."""

import base64
import json
import time
from pathlib import Path

import pytest

from lucida.renderer.notebook import explore

pytestmark = pytest.mark.filterwarnings("ignore")  # Playwright's own
SIZE = (80, 60)
FULL = "canvas[data-factor='1']"
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
def shared(browser):
    """A page that shows a widget; shared.widget is that."""
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
    page.first = widget.camera
    page.on("pageerror", lambda error: page.errors.append(error))
    page.set_content(PAGE % parts)
    page.locator(FULL).wait_for()
    yield page
    page.close()


@pytest.fixture
def page(shared):
    """The page with the widget's first camera."""
    shared.locator("canvas").press("Home")
    until(shared, lambda: shared.widget.camera == shared.first)
    yield shared
    assert not shared.errors


def until(page, condition):
    end_s = time.monotonic() + 60
    while not condition():
        assert time.monotonic() < end_s
        page.wait_for_timeout(50)


def shown(page, is_awaited=bool):
    """Return the full image, once nothing changes and it is the awaited one."""
    found = []

    def look():
        page.wait_for_timeout(300)
        page.locator(FULL).wait_for()
        found.append(page.locator("canvas").evaluate("canvas => canvas.toDataURL()"))
        return is_awaited(found[-1])

    until(page, look)
    return found[-1]


def test_mouse_keys_and_numbers_move_the_camera(page):
    widget, canvas = page.widget, page.locator("canvas")
    first, images = widget.camera, [shown(page)]
    box = canvas.bounding_box()
    x, y = box["x"] + 40, box["y"] + 30

    def changed():
        images.append(shown(page, lambda image: image != images[-1]))
        return images[-1] != images[-2]

    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 20, y + 5, steps=5)
    page.mouse.up()
    assert changed() and widget.camera.distance == first.distance and widget.pixel is None
    eye = widget.camera.eye
    page.mouse.wheel(0, -100)
    assert changed() and widget.camera.eye != eye
    canvas.press("Home")
    images.append(shown(page, lambda image: image == images[0]))
    assert widget.camera == first
    number = page.get_by_label("field of view").last
    number.fill("60")
    number.press("Enter")
    assert changed() and widget.camera.fov_y_deg == pytest.approx(60)
    number.fill("200")
    number.press("Enter")
    page.get_by_role("alert").get_by_text("200 is not between 0 and 180").wait_for()
    page.get_by_label("eye x").first.fill("900")  # thousandths of the slider's range
    assert changed() and widget.camera.eye[0] > 5
    page.get_by_label("projection").select_option("parallel")
    assert changed() and widget.camera.is_parallel
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
    assert page.widget.pixel is None and page.locator(".hit tr").count() == 0


def test_nothing_piles_up_while_the_kernel_is_busy(page):
    page.is_busy = True
    page.mouse.move(40, 30)
    page.mouse.down()
    page.mouse.move(60, 40, steps=20)
    page.mouse.up()
    page.get_by_text("The kernel is busy.").wait_for()
    assert page.unanswered == 2
