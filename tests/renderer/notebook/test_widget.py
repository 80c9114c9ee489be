"""The live widget without a browser: questions and answers over its comm, and its traitlets."""

import io
import sys
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image

from lucida import Camera, Lens, LucidaError, load_scene, picture
from lucida.renderer.notebook import explore
from lucida.renderer.notebook.sliders import is_level, sliders_of, with_number
from lucida.renderer.notebook.widget import PUSH_S
from lucida.renderer.scene.focus import Focus

SIZE = (80, 60)
MIDDLE = [30, 40]


class Browser:
    """Play the browser: it asks until an image is ready, and keeps what is sent."""

    def __init__(self, widget, monkeypatch):
        self.widget, self.sent = widget, []
        monkeypatch.setattr(widget, "send", lambda told, data=(): self.sent.append((told, data)))

    def asks(self, *moves, moving=False):
        problems = {}
        while True:
            content = {"ask": len(self.sent), "moves": moves, "moving": moving}
            data = {"method": "custom", "content": content}
            self.widget.comm.handle_msg({"content": {"data": data}, "buffers": []})
            told = self.sent[-1][0]
            assert told["answer"] == content["ask"]
            problems |= {"problem": told["problem"]} if "problem" in told else {}
            if "pending" not in told:
                return problems | told
            moves = ()

    @property
    def image(self):
        return np.asarray(Image.open(io.BytesIO(self.sent[-1][1][0])))


@pytest.fixture
def browser(monkeypatch):
    return Browser(explore("spheres", size=SIZE), monkeypatch)


def test_the_image_at_rest_is_exact_and_one_in_motion_is_small(browser):
    told = browser.asks()
    assert (told["type"], told["factor"], told["full"]) == ("image/png", 1, True)
    assert (browser.image == picture(browser.widget.frame)).all()
    first = browser.widget.camera
    assert first == load_scene("spheres").view.for_size(SIZE)
    told = browser.asks({"do": "orbit", "right": 0.3, "up": 0.1}, moving=True)
    assert told["type"] == "image/jpeg" and not told["full"]
    assert browser.image.shape[0] == -(-60 // told["factor"])
    assert browser.widget.camera != first
    assert browser.asks({"do": "reset"})["full"] and browser.widget.camera == first


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_what_is_dragged_follows_the_pointer(browser, projection):
    widget = browser.widget
    if projection == "parallel":
        browser.asks({"do": "project"})
    assert widget.camera.projection == projection
    browser.asks({"do": "mark", "at": MIDDLE})
    point = widget.hit["point"]
    for start, end in ((MIDDLE, [32, 44]), ([32, 44], [36, 52])):
        browser.asks({"do": "pan", "drag": 0.5, "start": start, "end": end})
        seen = widget.camera.project(point, SIZE)
        np.testing.assert_allclose((seen.row, seen.column), end, atol=1e-3)
    viewport = widget.camera.viewport
    browser.asks({"do": "zoom", "at": [36, 52], "steps": 2})
    seen = widget.camera.project(point, SIZE)
    np.testing.assert_allclose((seen.row, seen.column), (36, 52), atol=1e-3)
    assert (widget.camera.viewport == viewport) == (projection == "perspective")


def test_a_marked_pixel_has_its_ray_and_its_hit(browser):
    told = browser.asks({"do": "mark", "at": MIDDLE})
    rows, hit = dict(told["hit"]), browser.widget.hit
    assert rows["pixel"].startswith("row 30, column 40") and browser.widget.pixel == (30, 40)
    assert hit["object"]["name"] in rows["object"] and rows["t"] == f"{hit['t']:.6g}"
    ray = browser.widget.camera.ray(30, 40, SIZE)
    np.testing.assert_allclose(hit["point"], ray.origin + hit["t"] * ray.direction)
    assert "hit" not in browser.asks({"do": "mark", "at": None})
    assert browser.widget.hit is None


def test_the_camera_is_a_traitlet_in_both_directions(browser):
    widget, seen = browser.widget, []
    lens = Lens("brown", {"k1": -0.2})
    widget.observe(lambda change: seen.append(change.new), "camera")
    widget.camera = Camera(eye=(1, 2, 9), lens=lens)
    table = widget.get_state("camera")["camera"]
    assert table["eye"] == [1.0, 2.0, 9.0] and table["lens"] == {"model": "brown", "k1": -0.2}
    widget.set_state({"camera": {**table, "eye": [0, 1, 5]}})
    assert widget.camera == seen[-1] == Camera(eye=(0, 1, 5), lens=lens)
    widget.set_state({"camera": {**table, "u": [0, 0, 0]}})
    assert "camera.u" in browser.sent[-1][0]["problem"] and widget.camera == seen[-1]
    for wrong, name in ((3, "int"), (None, "NoneType")):
        with pytest.raises(LucidaError, match=f"camera: is of type {name}, not a Camera"):
            widget.camera = wrong
    with pytest.raises(LucidaError, match=r"pixel: \(60, 0\) is outside an image of 80x60"):
        widget.pixel = (60, 0)
    widget.set_state({"pixel": [5, 900]})
    assert "pixel" in browser.sent[-1][0]["problem"] and widget.pixel is None
    widget.pixel = (7, 8)
    assert widget.get_state("pixel")["pixel"] == (7, 8)
    assert "field of view" in browser.asks({"do": "set", "name": "fov", "value": 900})["problem"]
    assert widget.camera == seen[-1]


def test_a_cell_that_moves_the_camera_sends_few_images(browser, monkeypatch):
    """None before somebody looks; then at most as many as can be seen."""
    widget, now_s = browser.widget, 9.0
    clock = SimpleNamespace(monotonic=lambda: now_s)
    monkeypatch.setattr("lucida.renderer.notebook.widget.time", clock)
    widget.camera = Camera(eye=(0, 1, 5))
    assert not browser.sent
    browser.asks()
    count = len(browser.sent)
    for now_s in np.arange(10.0, 11.0, PUSH_S / 5):
        widget.camera = Camera(eye=(0, 1, now_s))
    assert 20 <= len(browser.sent) - count <= 25
    assert (browser.asks()["answer"], widget.camera.eye[2]) == (len(browser.sent) - 1, now_s)


CAMERAS = {
    "level": Camera.look_at((4, 3, 6), (0, 1, 0), fov_y_deg=40),
    "skewed": Camera(u=(1, 0.2, 0)),
    "parallel": Camera(eye=(0, 1, 5), projection="parallel"),
    "lens": Camera(eye=(0, 1, 5), lens=Lens("fisheye", {"k1": 0.04})),
}


@pytest.mark.parametrize("name", CAMERAS)
def test_a_slider_s_number_is_what_the_camera_then_has(name):
    camera, target, focus = CAMERAS[name], (0.0, 1.0, 0.0), Focus((0.0, 1.0, 0.0), 9.0)
    assert is_level(camera) == (name != "skewed")
    for slider in sliders_of(camera, target, focus):
        value = slider.value + 0.05 * (slider.high - slider.low)
        after = with_number(camera, slider.name, value, target)
        if not slider.name.startswith("target"):
            now = {s.name: s.value for s in sliders_of(after, target, focus)}
            assert now.get(slider.name, value) == pytest.approx(value), slider
        else:
            aim = [value if slider.name[-1] == str(k) else target[k] for k in range(3)]
            seen = after.project(aim, (3, 3))
            np.testing.assert_allclose((seen.row, seen.column), (1, 1), atol=1e-9)


def test_without_anywidget_one_line_says_what_to_install(monkeypatch):
    monkeypatch.delitem(sys.modules, "lucida.renderer.notebook.widget", raising=False)
    monkeypatch.setitem(sys.modules, "anywidget", None)
    with pytest.raises(LucidaError, match=r"anywidget is not installed; .*pip install anywidget"):
        explore("columns")
