"""A scene's page in a browser: its rays and images are the program's, and it asks for nothing."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

from lucida import Camera, Tracer
from lucida.app.cli import main
from lucida.app.web.scene_page import scene_page
from lucida.renderer.files.views import view_from_toml, view_table
from lucida.renderer.images import picture
from lucida.renderer.scene import (
    Checker,
    DirectionalLight,
    Material,
    Mesh,
    PointLight,
    Scene,
    SceneObject,
    Sphere,
    Texture,
)
from lucida.renderer.scene.model import View
from lucida.renderer.scene.shapes import torus
from tests.support.browser import Page, unexplained
from tests.support.page_cameras import LENSES, random_cameras, ray_error
from tests.support.textured import noise

SIZE = (64, 48)


def _painted():
    """Return a scene with all that a surface can show, and enough triangles for a hierarchy."""
    corners = [(-2, -1, -2), (2, -1, -2), (2, 2, -2), (-2, 2, -2)]
    uv = [(-0.5, -0.5), (1.5, -0.5), (1.5, 1.5), (-0.5, 1.5)]
    colors = [(1, 0.5, 0.5), (1, 1, 0.5), (0.5, 1, 1), (1, 1, 1)]
    wall = Mesh(corners, [(0, 1, 2), (0, 2, 3)], colors=colors, uv=uv)
    holes = np.dstack([noise(8, 8), 255 * (noise(8, 8, 2)[..., :1] > 90)]).astype(np.uint8)
    grid = Mesh(np.array(corners) * 0.7 + (0, 0, 2.5), wall.faces, uv=uv)
    return Scene(
        (
            SceneObject(wall, Material(texture=Texture(noise(16, 8), ("mirror", "clamp")))),
            SceneObject(grid, Material(texture=Texture(holes), cutout=0.5, single_sided=True)),
            SceneObject(Sphere((1, 0, 0), 0.8), Material(texture=Texture(noise(32, 16)))),
            SceneObject(Sphere((-1, 0, 0.3), 0.7), Material(checker=Checker((0.9, 0.8, 0.2), 0.3))),
            SceneObject(torus(1.3, 0.25, 24, 12), Material(specular=(0.4, 0.4, 0.5))),
        ),
        (
            PointLight((2, 3, 4), (0.6, 0.6, 0.5)),
            DirectionalLight((0.4, -0.5, -1), (0.4, 0.4, 0.5)),
        ),
        view=View(Camera.look_at((0.5, 0.6, 6), (0, 0, 0), fov_y_deg=40), fit=True),
        name="painted",
    )


@pytest.fixture(scope="module")
def scene():
    return _painted()


@pytest.fixture(scope="module")
def shared(browser, scene, tmp_path_factory):
    """A page for all tests, of few pixels: Chromium draws them on the processor.

    It sends no request, and reports nothing.
    """
    file = tmp_path_factory.mktemp("pages") / "painted.html"
    file.write_text(scene_page(scene, scene.view), encoding="utf-8")
    opened = Page(browser, file, viewport={"width": 880, "height": 500}, device_scale_factor=0.25)
    opened.tab.evaluate("lucida.ready")
    yield opened
    opened.tab.close()
    assert opened.problems == []


@pytest.fixture
def page(shared, scene):
    """The page with its first camera and settings, drawn."""
    for label in ("shadows", "reflections"):
        shared.tab.get_by_label(label).uncheck()
    shared.tab.get_by_role("radio", name="Side by side").check()
    shared.tab.evaluate("camera => lucida.set(camera)", view_table(scene.view))
    shared.drawn()
    return shared


@pytest.fixture
def tab(page):
    return page.tab


def test_rays_are_the_programs(page):
    assert ray_error(page, random_cameras(3, 60)) <= 1e-12  # each lens once


def test_both_images_are_the_programs(page, scene):
    cameras = [scene.view.for_size(SIZE), *random_cameras(9, 3)]
    with Tracer(scene) as tracer:
        for camera in cameras:
            frame = tracer.render(camera, SIZE, ("color", "primitive"))
            page.tab.evaluate("camera => lucida.set(camera)", view_table(View(camera)))
            for kind in ("ray", "raster"):
                image = page.image(kind, SIZE)
                assert not unexplained(image, picture(frame), frame.channel("primitive")).any(), (
                    camera
                )


def test_shadows_and_reflections_are_the_tracer_s(page, tab, scene):
    for label in ("shadows", "reflections"):
        tab.get_by_label(label).check()
    with Tracer(scene, shadows=True, mirror_depth=2) as tracer:
        frame = tracer.render(scene.view.for_size(SIZE), SIZE, ("color", "primitive"))
    image = page.image("ray", SIZE)
    assert unexplained(image, picture(frame), frame.channel("primitive")).sum() <= 3


def test_camera_as_text_and_in_the_address(tab, page):
    cameras = random_cameras(21, 3)  # a pinhole, a parallel camera, a lens
    for camera in (cameras[2], *cameras):
        tab.evaluate("camera => lucida.set(camera)", view_table(View(camera)))
        assert view_from_toml(tab.get_by_label("as a view file").input_value()).camera == camera
    page.until(f"location.hash.includes('{camera.eye[0]!r}')")
    address = tab.evaluate("location.hash")
    tab.evaluate("lucida.set({eye: [1, 2, 3], projection: 'perspective', lens: null, near: 0.5})")
    page.until("location.hash.includes('1%2C2%2C3')")
    tab.evaluate("hash => { location.hash = hash; }", address)
    page.until(f"lucida.camera.eye[0] === {camera.eye[0]!r}")
    assert "near" not in tab.evaluate("lucida.camera")
    tab.evaluate("location.hash = '#camera=%7B'")
    page.until("document.body.textContent.includes('the address holds no camera')")


def test_keys_pointer_and_sliders_move_the_camera(tab):
    before = tab.evaluate("lucida.camera.eye")
    image = tab.locator(".lucida-image canvas").first
    image.focus()
    tab.keyboard.press("ArrowLeft")
    after = tab.evaluate("lucida.camera.eye")
    assert after != before
    box = image.bounding_box()
    tab.mouse.move(box["x"] + 100, box["y"] + 100)
    tab.mouse.down()
    tab.mouse.move(box["x"] + 180, box["y"] + 130, steps=3)
    tab.mouse.up()
    assert tab.evaluate("lucida.camera.eye") != after
    tab.get_by_label("Distance d, number").fill("2.5")
    tab.keyboard.press("Tab")
    assert tab.evaluate("lucida.camera.distance") == 2.5
    tab.get_by_label("parallel").check()
    assert tab.evaluate("lucida.camera.projection") == "parallel"


def test_the_probe_says_what_a_pixel_sees(page, tab, scene):
    image = tab.get_by_role("img", name="Ray image")
    image.click(position={"x": 200, "y": 150})
    tab.get_by_role("button", name="Next column").click()
    page.drawn()
    words = tab.locator(".lucida-pixel").text_content()
    row, column, width, height, _ = map(int, re.findall(r"\d+", words))
    with Tracer(scene) as tracer:
        size = width, height
        frame = tracer.render(scene.view.for_size(size), size, ("depth",))
    depth = float(frame.channel("depth")[row, column])
    shown = re.search(r"at t = ([\d.]+)", tab.locator(".lucida-probe dl").text_content())[1]
    assert float(shown) == pytest.approx(depth, rel=1e-3)


@pytest.mark.parametrize("lens", LENSES[::3], ids=lambda lens: lens.model)
def test_the_probe_shows_the_way_through_a_lens(page, tab, lens):
    tab.evaluate("lens => lucida.set({lens})", {"model": lens.model, **lens.coefficients})
    page.drawn()
    names = tab.locator(".lucida-lines dt").all_text_contents()
    lines = tab.locator(".lucida-lines dd").evaluate_all("all => all.map((one) => one.innerHTML)")
    shown = dict(zip(names, lines, strict=True))

    def last(name):
        found = re.findall(r"\(([^()]*)\)", shown[name].replace("\u2212", "-"))[-1]
        return [float(number) for number in found.split(",")]

    place = last("on the image plane at distance 1, downwards")
    way = last("direction in the camera, forwards")
    np.testing.assert_allclose(way, lens.direction(*place), atol=2e-3)
    is_distorted = lens.model != "fov" and bool(lens.coefficients)
    assert is_distorted == any(name.startswith("distortion") for name in names)
    if is_distorted:
        assert "Newton" in str(names)
    assert shown["direction in the camera, forwards"].startswith("<math")


def test_the_viewport_is_that_of_the_image(tab, scene):
    size = tab.evaluate(
        "(canvas => [canvas.width, canvas.height])(document.querySelector('canvas'))"
    )
    left, right, bottom, top = scene.view.for_size(size).viewport
    field = tab.get_by_label("Viewport, right, number")
    assert float(field.input_value()) == pytest.approx(right, rel=1e-3)
    field.fill("0.9")
    tab.keyboard.press("Tab")
    assert tab.evaluate("lucida.camera.viewport") == pytest.approx([left, 0.9, bottom, top])


# Let a camera that sees one point be followed by another while the workers compare its images.
FOLLOWED = """() => { const { postMessage } = Worker.prototype;
  lucida.set({ distance: 1e4 });
  Worker.prototype.postMessage = function (message) {
    postMessage.call(this, message);
    if (message.isWhole && lucida.camera.distance === 1e4) lucida.set({ distance: 2 });
  };
  const result = document.querySelector(".lucida-result");
  window.said = [];
  new MutationObserver(() => said.push(result.textContent)).observe(result, { childList: true });
}"""


def test_the_difference_is_counted_for_the_last_camera(page, tab):
    tab.evaluate(FOLLOWED)
    tab.get_by_role("radio", name="Difference").check()
    first = "said.find((text) => text.includes('differ by'))"
    page.until(first)
    words = tab.evaluate(first)
    unlike, count = map(int, re.findall(r"\d+", words)[:2])
    assert 0 < unlike < 0.01 * count
    shown = tab.locator("figure:not([hidden]) canvas[aria-label^='Difference']")
    size = tuple(int(shown.get_attribute(side)) for side in ("width", "height"))
    ray, raster = (page.image(kind, size).astype(int) for kind in ("ray", "raster"))
    assert unlike == (np.abs(ray - raster) > 1).any(axis=2).sum()


def test_a_lost_webgl_context_is_reported_and_comes_back_with_the_last_camera(page, tab):
    tab.evaluate(
        """window.drawn = [...document.querySelectorAll(".lucida-image canvas")]
          .filter((canvas) => canvas.checkVisibility() && canvas.getContext("webgl2"));
        window.losing = drawn.map((c) => c.getContext("webgl2").getExtension("WEBGL_lose_context"));
        for (const canvas of drawn) canvas.classList.add("drawn");"""
    )
    assert tab.evaluate("losing.length") == 2  # the raster image and the outside view
    tab.evaluate("lucida.set({distance: 1.5})")
    image = page.image("raster", SIZE)
    page.drawn()
    right = _screenshots(tab)
    tab.evaluate("lucida.set({distance: 1})")
    page.drawn()
    reports = (
        "[...document.querySelectorAll('figure p')].filter((p) => /is lost/.test(p.innerText))"
    )
    tab.evaluate("losing.forEach((context) => context.loseContext())")
    try:
        page.until(f"{reports}.length === 2")
        refused = "lucida.pixels('raster', [8, 8]).catch((error) => error.message)"
        assert "is lost" in tab.evaluate(refused)
        tab.evaluate("lucida.set({distance: 1.5})")
        page.drawn()
    finally:
        tab.evaluate("losing.forEach((context) => context.restoreContext())")
    page.until(f"{reports}.length === 0")
    assert _screenshots(tab) == right
    np.testing.assert_array_equal(page.image("raster", SIZE), image)


def _screenshots(tab):
    return [canvas.screenshot() for canvas in tab.locator(".drawn").all()]


def test_a_camera_that_cannot_be_is_refused(tab):
    script = "f => { try { lucida.set(f); return ''; } catch (error) { return error.message; } }"
    for fields in (
        {"eye": [1, 2]}, {"eye": [1, None, 2]}, {"u": [0, 0, 0]}, {"distance": -1}, {"near": -1},
        {"viewport": [1, 0, 0, 1]}, {"projection": "x"}, {"lens": {"model": "x"}}, {"nothing": 1},
    ):  # fmt: skip
        assert tab.evaluate(script, fields), fields


def test_axe_finds_nothing(page):
    assert [(one["id"], one["nodes"][0]["html"]) for one in page.axe()] == []


HOSTILE = (
    "</script><script>window.hacked = 1</script>",
    "<img src=x onerror='window.hacked = 1'>",
    '"><svg onload=window.hacked=1>',
    "<!--<script>",
    "]]>",
    "{{7*7}}",
    "\u2028\u2029\x00",
    "&lt;b&gt;",
    "javascript:window.hacked=1",
    "`${window.hacked = 1}`",
    "'; window.hacked = 1; '",
    "__proto__",
)


PARSED = """html => { const page = new DOMParser().parseFromString(html, "text/html");
  const found = [...page.querySelectorAll("h1, script, img, svg")].map(({ tagName }) => tagName);
  return [page.querySelector("h1").textContent, found.sort()]; }"""


def test_without_webgl_and_with_hostile_names(browser, tmp_path):
    ball = Sphere((0, 0, 0), 1)
    objects = tuple(SceneObject(ball, name=name) for name in HOSTILE)
    tab = browser.new_page()
    tab.add_init_script(
        """const get = HTMLCanvasElement.prototype.getContext;
        HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
          return kind === "webgl2" ? null : get.call(this, kind, ...rest); };"""
    )
    view = View(Camera.look_at((0, 0, 4), (0, 0, 0)))
    file = tmp_path / "hostile.html"
    for number in range(0, len(HOSTILE), 4):
        name = "".join(HOSTILE[number : number + 4])
        html = scene_page(Scene(objects, name=name, view=view), view)
        assert html.count("</script>") == 2
        heading, elements = tab.evaluate(PARSED, html)
        assert heading == name or not name.isprintable()
        assert elements == ["H1", "SCRIPT", "SCRIPT"], name
    file.write_text(scene_page(Scene(objects, name="".join(HOSTILE), view=view), view), "utf-8")
    tab.goto(file.as_uri())
    tab.evaluate("lucida.ready")
    assert tab.evaluate("window.hacked") is None
    assert tab.locator("h1").count() == 1
    assert "no WebGL" in tab.locator("p[role=status]").first.text_content()
    assert tab.get_by_label("Wipe", exact=True).count() == 0
    assert tab.evaluate("lucida.pixels('ray', [8, 8]).then((image) => image.data[3])") == 255
    tab.close()


def test_the_command_writes_a_small_page(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["page", "still-life", "-o", "a.html", "--eye", "0,2,9"]) == 0
    assert Path("a.html").stat().st_size < 1_000_000
    assert json.dumps([0.0, 2.0, 9.0], separators=(",", ":")) in Path("a.html").read_text()
    assert main(["page", "still-life", "-o", "a.png"]) == 2
    assert "give .html" in capsys.readouterr().err
