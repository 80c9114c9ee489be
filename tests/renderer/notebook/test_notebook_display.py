"""The display in notebooks: short texts, pictures, tables; nothing of a file's text as HTML."""

import base64
import io
import re
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest
from PIL import Image

from lucida import Camera, Frame, LucidaError, Tracer, View, load_scene, picture
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.notebook.display import camera_svg

SIZE = (40, 30)


@pytest.fixture(scope="module")
def frame():
    scene = load_scene("columns")
    with Tracer(scene) as tracer:
        return tracer.render(scene.view.for_size(SIZE), SIZE)


def opened(data):
    return np.asarray(Image.open(io.BytesIO(data)).convert("RGB"))


def test_a_frame_is_its_picture(frame):
    data = frame._repr_png_()
    assert data is not None and (opened(data) == picture(frame)).all()
    assert Frame(SIZE)._repr_png_() is None
    depth = replace(frame, color=None)._repr_png_()
    assert depth is not None and (opened(depth) == picture(frame, "depth")).all()


def test_a_channel_has_its_values_and_its_shape(frame):
    assert frame.depth is not None
    shown = frame.show("depth")._repr_html_()
    near = frame.depth[np.isfinite(frame.depth)].min()
    assert f"t = {near:.4g}<" in shown and "30 x 40, float32" in shown
    image, bar = (opened(base64.b64decode(data)) for data in re.findall("base64,([^']+)'", shown))
    assert (image == picture(frame, "depth")).all()
    assert bar[0, 0, 0] == 255 and bar[-1, 0, 0] == 51  # as the image's nearest and farthest
    assert len(re.findall("<img", frame.show("normal")._repr_html_())) == 1  # without a bar
    assert "None" not in frame.show("normal")._repr_html_()
    nothing = Frame(SIZE, depth=np.full((30, 40), np.inf, np.float32)).show("depth")
    assert "nothing is hit" in nothing._repr_html_()
    with pytest.raises(LucidaError, match="'primitive' was not rendered"):
        frame.show("primitive")


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_a_camera_is_drawn_and_told(projection):
    camera = Camera.look_at((4, 3, 6), (0, 1, 0), fov_y_deg=40, aspect=1.5, projection=projection)
    told = replace(camera, near=0.25)._repr_html_()
    assert "(4, 3, 6)" in told and ("field of view" in told) == (projection == "perspective")
    assert "<th>near</th><td>0.25</td>" in told and "<th>far</th>" not in told
    root = ElementTree.fromstring(camera_svg(camera))
    width, height = int(root.attrib["width"]), int(root.attrib["height"])
    numbers = [float(n) for path in re.findall(r"points='([^']+)'", camera_svg(camera))
               for n in re.split("[ ,]", path)]  # fmt: skip
    assert len(numbers) == 8
    assert all(0 <= x <= width for x in numbers[::2])
    assert all(0 <= y <= height for y in numbers[1::2])
    # As seen from behind the camera: the viewport's left is left, its top is above.
    (left, top), (right, _), _, (_, bottom) = zip(numbers[::2], numbers[1::2], strict=True)
    assert left < right and top < bottom
    svg, pair = camera_svg(camera), r"([\d.]+),([\d.]+)"
    rays = np.array(re.findall(rf"<path d='M{pair} L{pair}' stroke='#888'", svg), float)
    starts, ends = rays[:, :2], rays[:, 2:]
    np.testing.assert_allclose(ends.ravel(), numbers)
    (eye,) = re.findall(r"<circle cx='([\d.]+)' cy='([\d.]+)'", svg)
    if projection == "perspective":
        assert (starts == np.array(eye, float)).all()
    else:
        np.testing.assert_allclose(starts - ends, (starts - ends)[[0] * 4], atol=0.2)
        np.testing.assert_allclose(starts.mean(axis=0), np.array(eye, float), atol=0.2)


@pytest.mark.parametrize(("model", "points", "rays"), [("brown", 96, 4), ("equisolid", 56, 0)])
def test_a_lens_is_told_and_its_border_drawn(model, points, rays):
    """The equisolid one sees radii up to 2, of sides at 1.45 and 1.9."""
    brown = model == "brown"
    lens = Lens(model, {"k1": -0.02} if brown else {})
    camera = Camera(viewport=(-1, 1, -1, 1) if brown else (-1.45, 1.45, -1.9, 1.9), lens=lens)
    assert f"<th>lens</th><td>{lens}</td>" in camera._repr_html_()
    svg = camera_svg(camera)
    (outline,) = re.findall("points='([^']+)'", svg)
    assert len(outline.split()) == points and "nan" not in svg
    assert svg.count("stroke='#888'") == rays


def test_a_scene_is_its_picture_and_its_contents():
    scene = load_scene("columns")
    named = replace(scene.objects[0], name="<script>alert(1)</script>")
    view = View(Camera(eye=(0, 1, 9)), fit=True)
    shown = replace(scene, objects=(named, *scene.objects[1:]), view=view, origin=None)
    told = shown._repr_html_()
    (data,) = re.findall("base64,([^']+)'", told)
    assert opened(base64.b64decode(data)).shape == (240, 320, 3)
    assert "<th>left column 1</th><td>mesh, 192 triangles</td>" in told
    assert "<td>sphere</td>" in told
    assert "<script" not in told and "&lt;script&gt;" in told
    assert "and 39 more" in told
