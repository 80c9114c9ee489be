"""Images through lenses: looked up, resampled, with moved vertices; against float64 rays."""

from dataclasses import replace

import numpy as np
import pytest
from raster_scenes import square, still_life
from trace_reference import reference

from renderer import Camera, LucidaError, Scene
from renderer.compare import CHANNELS, compare_frames
from renderer.lens_drawing import LensDrawing
from renderer.lens_faces import looked_up_faces
from renderer.lenses import Lens
from renderer.raster.moved import check_pieces
from renderer.scene.flat import flatten
from renderer.scene.model import SceneObject

SIZE = (48, 32)
EYE = Camera.look_at((2, 1.5, 4), (0, 0, 0), aspect=1.5)
# Each lens, and half the width of its viewport.
LENSES = {
    "brown": (Lens("brown", {"k1": -0.2, "p1": 0.02, "k4": 0.05}), 0.8),
    "wide brown": (Lens("brown", {"k1": 0.1}), 2.9),
    "fisheye": (Lens("fisheye", {"k1": 0.05}), 1.9),
    "fov": (Lens("fov", {"omega": 0.9}), 0.9),
    "thin_prism_fisheye": (Lens("thin_prism_fisheye", {"k1": 0.02, "sx1": 0.01}), 1.1),
    "equidistant": (Lens("equidistant"), 3.3),
    "stereographic": (Lens("stereographic"), 3.5),
    "equisolid": (Lens("equisolid"), 2.2),
    "orthographic": (Lens("orthographic"), 1.1),
    "equirectangular": (Lens("equirectangular"), np.pi),
    "cylindrical": (Lens("cylindrical"), 2.6),
}


def through(name: str, **changes) -> Camera:
    """A skewed camera with one of LENSES."""
    lens, half = LENSES[name]
    camera = replace(EYE, lens=lens, distance=0.7, u=tuple(np.add(EYE.u, (0, 0.1, 0))))
    half *= camera.distance
    return replace(camera, viewport=(-half, half, -half / 1.5, half / 1.5), **changes)


@pytest.mark.parametrize("name", LENSES)
def test_looked_up_pixels_differ_only_by_a_texel(rasterizer, name):
    scene, camera = still_life(), through(name, near=1.5, far=9.0)
    flat, ray = flatten(scene), reference(scene, camera, SIZE)
    rasterizer.set_scene(scene)
    differing = []
    for enlargement in (1, 4):
        drawing = LensDrawing(enlargement=enlargement)
        frame = rasterizer.render(camera, SIZE, CHANNELS, lens_drawing=drawing)
        result = compare_frames(flat, camera, SIZE, frame, ray, lens_drawing=drawing)
        assert result.unexplained == 0, result.summary()
        differing.append(result.pixels - result.agree)
        assert result.outside == np.isnan(camera.rays(SIZE).direction[..., 0]).sum()
    assert differing[1] < differing[0] < 0.2 * result.pixels


def test_a_lens_that_does_nothing_shows_the_pinholes_image(rasterizer):
    scene = still_life()  # without the floor, which extends behind the eye
    rasterizer.set_scene(replace(scene, objects=scene.objects[1:]))
    camera = replace(through("brown"), lens=Lens("brown"))
    pinhole = rasterizer.render(camera.pinhole, SIZE, CHANNELS)
    for drawing in (LensDrawing(enlargement=1), LensDrawing("resampled"), LensDrawing("vertices")):
        frame = rasterizer.render(camera, SIZE, CHANNELS, lens_drawing=drawing)
        is_exact = drawing.method != "vertices"  # whose spheres are split octahedra
        assert (frame.primitive != pinhole.primitive).mean() <= (0 if is_exact else 0.02)
        same = frame.primitive == pinhole.primitive
        tolerance = 1e-5 if is_exact else 0.05
        np.testing.assert_allclose(frame.depth[same], pinhole.depth[same], rtol=tolerance)
        if is_exact:
            np.testing.assert_allclose(frame.color, pinhole.color, atol=1e-4)


def test_a_resampled_image_is_black_where_the_pinhole_sees_nothing(rasterizer):
    rasterizer.set_scene(still_life())
    camera = through("fisheye")
    frame = rasterizer.render(camera, SIZE, CHANNELS, lens_drawing=LensDrawing("resampled"))
    origin, direction = camera.rays(SIZE)
    row, column, _ = camera.pinhole.project(origin + direction, SIZE)
    seen = (row > -0.5) & (row < SIZE[1] - 0.5) & (column > -0.5) & (column < SIZE[0] - 0.5)
    assert 0.1 < seen.mean() < 0.9
    assert (frame.color[seen].sum(axis=-1) > 0).all()  # the background is blue
    assert not frame.color[~seen].any()
    assert (frame.id[~seen] == -1).all()
    assert np.isinf(frame.depth[~seen]).all()


def test_vertices_go_where_the_lens_shows_them_and_edges_stay_straight(rasterizer):
    scene = Scene((SceneObject(square(3.0, -1.0)),))
    rasterizer.set_scene(scene)
    camera = replace(Camera(), lens=Lens("stereographic"), viewport=(-1.5, 1.5, -1.5, 1.5))
    size = (64, 64)
    corner = camera.project((1.5, 1.5, -1.0), size)
    frame = rasterizer.render(camera, size, CHANNELS, lens_drawing=LensDrawing("vertices"))
    rows, columns = np.nonzero(frame.id >= 0)
    assert rows.min() == np.ceil(corner.row)
    assert columns.max() == np.floor(corner.column)
    assert len(rows) == (np.floor(corner.column) - np.ceil(63 - corner.column) + 1) ** 2  # a square
    ray, wrong = reference(scene, camera, size), []
    for splitting in (0, 2, 4):
        drawing = LensDrawing("vertices", splitting=splitting)
        frame = rasterizer.render(camera, size, CHANNELS, lens_drawing=drawing)
        result = compare_frames(flatten(scene), camera, size, frame, ray, lens_drawing=drawing)
        assert result.unexplained == 0
        wrong.append(result.wrong)
        assert f"{result.wrong} pixel" in result.summary_short()
    assert wrong[0] > 4 * wrong[1] > 4 * wrong[2]


def test_parts_make_the_same_image(rasterizer):
    rasterizer.set_scene(still_life())
    for camera, drawing in (
        (through("equirectangular"), LensDrawing()),
        (through("brown"), LensDrawing("resampled")),
        (through("fisheye"), LensDrawing("vertices", splitting=2)),
    ):
        whole = rasterizer.render(camera, SIZE, CHANNELS, lens_drawing=drawing)
        given = camera, SIZE, "parts"
        for face in range(rasterizer.faces(camera, SIZE, drawing)):
            first = 0
            while not rasterizer.see(*given, first, 5, drawing, face):
                first += 5
                rasterizer.draw(through("cylindrical"), SIZE)  # elsewhere
            for row in range(0, SIZE[1], 10):
                rasterizer.shade(*given, (row, min(row + 10, SIZE[1])), drawing, face)
        parts = rasterizer.read(CHANNELS, place="parts")
        for channel in CHANNELS:
            np.testing.assert_array_equal(parts[channel], whole.channel(channel))


def test_samples_and_a_lens_that_sees_nothing(rasterizer):
    rasterizer.set_scene(still_life())
    four = rasterizer.render(through("fisheye"), SIZE, samples=4)
    one = rasterizer.render(through("fisheye"), SIZE)
    assert 0 < np.abs(four.color - one.color).mean() < 0.1
    beyond = replace(through("orthographic"), viewport=(5, 6, 5, 6))
    for drawing in (LensDrawing(), LensDrawing("resampled"), LensDrawing("vertices")):
        frame = rasterizer.render(beyond, SIZE, CHANNELS, lens_drawing=drawing)
        assert (frame.primitive == -1).all()
        assert np.allclose(frame.color, still_life().background)


def test_a_panorama_has_six_faces_and_a_narrow_lens_one():
    assert len(looked_up_faces(through("equirectangular"), SIZE).faces) == 6
    assert len(looked_up_faces(through("brown"), SIZE).faces) == 1


@pytest.mark.parametrize(
    ("given", "field"),
    [
        ({"method": "matrix"}, "lens_drawing.method"),
        ({"enlargement": 3}, "lens_drawing.enlargement"),
        ({"splitting": 5}, "lens_drawing.splitting"),
    ],
)
def test_what_is_no_drawing_is_named(given, field):
    with pytest.raises(LucidaError) as error:
        LensDrawing(**given)
    assert error.value.field == field


def test_too_many_pieces_are_refused():
    flat = flatten(Scene((SceneObject(square(1.0)),)))
    check_pieces(flat, 4)
    many = flat._replace(faces=np.zeros((20000, 3), np.int32))
    with pytest.raises(LucidaError, match="split less"):
        check_pieces(many, 4)
