"""The outside view's diagram as SVG: read by an XML parser, against the cameras' own arithmetic."""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from app.outside.bitmap import bitmap, magnified
from app.outside.camera_diagram import Content, diagram
from app.outside.diagram import Arrow, Label, RayEnd, Segments
from app.outside.frustum import plane_corners
from app.outside.occlusion import Hidden, clipped, divided
from app.outside.options import OutsideOptions
from app.outside.outlines import MOST_TRIANGLES, Edges, Ellipse, outlines
from app.outside.projected import project
from app.outside.screen import OutsideScreen
from app.outside.svg import svg, write
from app.outside.vector import Arc, Drawing, Paint, Part, chains, dashes, drawing
from renderer.camera import Camera
from renderer.errors import LucidaError
from renderer.scene import shapes
from renderer.scene.model import Mesh, Scene, SceneObject, Sphere

SIZE = (320, 240)
SPACE = "{http://www.w3.org/2000/svg}"
CAMERA = Camera(eye=(0.3, -0.2, 2.0), viewport=(-0.8, 0.9, -0.4, 0.6), w=(0.1, 0.0, 1.0))
LOOKING = Camera.look_at((4.0, 2.5, 6.0), (0.3, 0.0, 0.0), fov_y_deg=40.0, aspect=4 / 3)
PARALLEL = Camera(
    LOOKING.eye, LOOKING.u, LOOKING.v, LOOKING.w, 1.0, (-4.0, 4.0, -3.0, 3.0), "parallel"
)
SKEWED = Camera(
    LOOKING.eye, LOOKING.u, (0.2, 1.1, 0.3), LOOKING.w, LOOKING.distance, LOOKING.viewport
)
PAINT = Paint(lambda role, tint: (1.0, 0.5, 0.0), (0.7, 0.7, 0.7), (0.1, 0.1, 0.1))
BALL = Sphere((0.3, 0.1, -0.4), 0.9)
BOX = shapes.box()
SCENE = Scene((SceneObject(BALL, name="ball"), SceneObject(BOX, name="box & <lid>")))


def made(
    looking: Camera = LOOKING,
    scene: Scene = SCENE,
    t: NDArray[np.float32] | None = None,
    extra: Any = (),
    **more: Any,
) -> Drawing:
    screen = OutsideScreen(looking, SIZE, 1e-3)
    items = diagram(Content(CAMERA, SIZE, OutsideOptions(**more), 4.0, [], RayEnd((100, 120), 2.0)))
    found, left_out = outlines(scene, screen)
    primitives = project([*items, *extra], screen)
    return drawing(primitives, found, PAINT, screen, t, left_out=left_out)


def forms(thing: SceneObject, looking: Camera = LOOKING) -> list[Edges | Ellipse]:
    """Return the outlines of one object."""
    found, _ = outlines(Scene((thing,)), OutsideScreen(looking, SIZE, 1e-3))
    return [outline.form for outline in found]


def parsed(picture: Drawing) -> ElementTree.Element:
    return ElementTree.fromstring(svg(picture, "a < b & c"))


def numbers(text: str) -> NDArray[np.float64]:
    return np.array(re.findall(r"-?\d+(?:\.\d+)?", text), float).reshape(-1, 2)


def group(root: ElementTree.Element, name: str) -> ElementTree.Element:
    found = root.find(f"{SPACE}g[@id='{name}']")
    assert found is not None
    return found


@pytest.mark.parametrize("looking", [LOOKING, PARALLEL, SKEWED])
class TestFile:
    def test_it_is_a_picture_with_a_group_for_each_kind(self, looking: Camera) -> None:
        root = parsed(made(looking))
        assert root.tag == f"{SPACE}svg" and root.get("viewBox") == "0 0 320 240"
        assert root.findtext(f"{SPACE}title") == "a < b & c"
        names = [part.get("id") for part in root.findall(f"{SPACE}g")]
        assert names == [
            *("outlines", "frustum", "image-plane", "rays", "marks", "basis", "eye", "letters")
        ]
        letters = [text.text for text in group(root, "letters")]
        assert {"u", "v", "w", "e", "t = 2"} <= set(letters)
        classes = {part.get("data-name") for part in group(root, "outlines")}
        assert classes == {"ball", "box & <lid>"}

    def test_its_coordinates_are_the_projections(self, looking: Camera) -> None:
        root = parsed(made(looking, grid=False))
        plane = group(root, "image-plane")
        (outline,) = [part for part in plane if part.get("data-name") == "image plane"]
        found = numbers(outline.get("d", ""))
        rows, columns, _ = looking.project(plane_corners(CAMERA), SIZE)
        expected = np.stack([columns + 0.5, rows + 0.5], axis=1)
        for corner in expected:
            assert np.abs(found - corner).max(axis=1).min() < 2e-3
        assert len(found) == 4 and outline.get("d", "").endswith("Z")
        # Each letter stands beside its arrow's tip.
        for name in "uvw":
            rim, text = [part for part in group(root, "letters") if part.text == name]
            assert rim.get("fill") == "none" and rim.get("x") == text.get("x")
            tip = np.asarray(CAMERA.eye) + np.asarray(getattr(CAMERA, name))
            row, column, _ = looking.project(tip, SIZE)
            at = float(text.get("x", "nan")), float(text.get("y", "nan"))
            assert math.dist(at, (float(column) + 0.5, float(row) + 0.5)) < 40

    def test_nothing_is_far_beside_the_page(self, looking: Camera) -> None:
        for part in made(looking).parts:
            if isinstance(part.form, np.ndarray):
                assert part.form.min() > -30 and (part.form < np.add(SIZE, 30)).all()


def ring_of(sphere: Sphere, looking: Camera) -> NDArray[np.bool_]:
    """At which places of the page the viewing ray meets the sphere."""
    rows, columns = np.mgrid[0 : SIZE[1], 0 : SIZE[0]]
    ray = looking.ray(rows, columns, SIZE)
    away = np.asarray(sphere.center) - ray.origin
    a = (ray.direction**2).sum(axis=-1)
    along = (away * ray.direction).sum(axis=-1)
    meets: NDArray[np.bool_] = (along**2 - a * ((away**2).sum(axis=-1) - sphere.radius**2) > 0) & (
        looking.is_parallel | (along > 0)
    )
    return meets


@pytest.mark.parametrize("looking", [LOOKING, PARALLEL, SKEWED])
def test_a_spheres_outline_is_the_ellipse_that_its_rays_fill(looking: Camera) -> None:
    (ellipse,) = forms(SceneObject(BALL), looking)
    assert isinstance(ellipse, Ellipse)
    rows, columns = np.mgrid[0 : SIZE[1], 0 : SIZE[0]]
    away = np.stack([columns + 0.5, rows + 0.5], axis=-1) - ellipse.center
    cosine, sine = math.cos(ellipse.tilt), math.sin(ellipse.tilt)
    x = (cosine * away[..., 0] + sine * away[..., 1]) / ellipse.radii[0]
    y = (-sine * away[..., 0] + cosine * away[..., 1]) / ellipse.radii[1]
    inside = x**2 + y**2 < 1
    meets = ring_of(BALL, looking)
    assert meets.sum() > 500
    assert (inside != meets).sum() <= 2  # on the very edge
    # Its depth is that of the rays that touch it.
    point = ellipse.at(np.array([0.7]))
    s = float(ellipse.depth_at(point)[0])
    t = s if looking.is_parallel else 1 / s
    ray = looking.ray(point[0, 1] - 0.5, point[0, 0] - 0.5, SIZE)
    touch = ray.origin + t * ray.direction
    assert math.isclose(math.dist(touch, BALL.center), BALL.radius, rel_tol=1e-3)


def test_a_sphere_that_reaches_behind_the_eye_has_short_lines_and_none_from_inside() -> None:
    eye, back = np.asarray(LOOKING.eye), np.asarray(LOOKING.w)
    beside = eye - 0.5 * back + 1.5 * np.asarray(LOOKING.u)
    for center, kind in ((beside, Edges), (eye + 0.1 * back, None), (eye + 9 * back, None)):
        x, y, z = center.tolist()
        found = forms(SceneObject(Sphere((x, y, z), 1.2)))
        assert [type(form) for form in found] == ([kind] if kind else [])


@pytest.mark.parametrize("looking", [LOOKING, PARALLEL, SKEWED])
@pytest.mark.parametrize("turned", [False, True])
def test_a_boxs_outline_is_its_hexagon_whatever_its_windings(looking: Camera, turned: bool) -> None:
    faces = BOX.faces.copy()
    if turned:
        faces[::3] = faces[::3, ::-1]
    mesh = Mesh(BOX.vertices, faces)
    (form,) = forms(SceneObject(mesh), looking)
    assert isinstance(form, Edges)
    # Six of the twelve edges are the outline of a box seen from a corner; the others are sharp.
    assert (~form.sharp).sum() == 6 and form.sharp.sum() == 6
    corners = np.unique(BOX.vertices.astype(float), axis=0)
    rows, columns, _ = looking.project(corners, SIZE)
    places = np.stack([columns + 0.5, rows + 0.5], axis=1)
    middle = places.mean(axis=0)
    (hexagon,) = chains(form.points[~form.sharp])
    assert np.allclose(hexagon[0], hexagon[-1])
    # Every corner is inside it or on it: the outline is the hull.
    ring = hexagon[:-1]
    for start, end in zip(ring, np.roll(ring, -1, axis=0), strict=True):
        across = np.array([start[1] - end[1], end[0] - start[0]])
        side = np.sign((middle - start) @ across)
        assert (side * ((places - start) @ across) > -1e-6 * np.abs(across).max()).all()


def test_edges_of_one_triangle_and_split_vertices() -> None:
    """A square of two triangles that share no vertex has four edges, not five."""
    corners = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 0, 0], [1, 1, 0], [0, 1, 0]], float)
    (form,) = forms(SceneObject(Mesh(corners, np.arange(6).reshape(2, 3))))
    assert isinstance(form, Edges)
    assert len(form.points) == 4 and not form.sharp.any()


def test_a_huge_mesh_is_left_out_and_the_file_says_so() -> None:
    count = MOST_TRIANGLES + 1
    huge = Mesh(np.eye(3), np.tile([0, 1, 2], (count, 1)))
    picture = made(scene=Scene((SceneObject(huge, name="dragon"), SceneObject(BALL, name="ball"))))
    root = parsed(picture)
    assert "dragon" in (root.findtext(f"{SPACE}desc") or "")
    assert {part.get("data-name") for part in group(root, "outlines")} == {"ball"}


def test_lines_are_dashed_behind_objects_and_solid_before_them() -> None:
    looking = Camera.look_at((0, 0, 6), (0, 0, 0), fov_y_deg=40.0, aspect=4 / 3)
    ball = Sphere((0.0, 0.0, 0.0), 1.0)
    meets = ring_of(ball, looking)
    # The ray parameter of the plane z = 0 through the ball stands in for its surface.
    plane = 6.0 / looking.distance
    t = np.where(meets, plane, np.inf).astype(np.float32)
    for z, behind in ((-0.5, True), (0.5, False)):
        across = Segments("across", "extra", np.array([[[-2.0, 0, z], [2.0, 0, z]]]), hidden=0.5)
        screen = OutsideScreen(looking, SIZE, 1e-3)
        picture = drawing(project([across], screen), [], PAINT, screen, t)
        lines = picture.parts
        assert [line.dashed for line in lines] == ([True, False, False] if behind else [False])
        if not behind:
            continue
        _, columns, _ = looking.project(np.array([[-1.0, 0, 0], [1.0, 0, 0]]), SIZE)
        ends = np.sort(np.asarray(lines[0].form)[:, 0])
        assert np.allclose(ends, columns + 0.5, atol=2.5)  # to the pixels of the depths
        assert lines[0].opacity == 0.5
        text = svg(picture)
        assert text.count("stroke-dasharray") == 1
    unknown = drawing(project([across], screen), [], PAINT, screen)
    assert unknown.notes == ("Nothing is hidden.",)


def test_an_objects_outline_ends_where_another_hides_it() -> None:
    looking = Camera.look_at((0, 0, 6), (0, 0, 0), fov_y_deg=40.0, aspect=4 / 3)
    near, far = Sphere((0.0, 0.0, 1.0), 0.6), Sphere((0.8, 0.0, -1.0), 0.8)
    t = np.full((SIZE[1], SIZE[0]), np.inf, np.float32)
    t[ring_of(far, looking)] = 6.5 / looking.distance
    t[ring_of(near, looking)] = 4.7 / looking.distance
    scene = Scene((SceneObject(far, name="far"), SceneObject(near, name="near")))
    screen = OutsideScreen(looking, SIZE, 1e-3)
    picture = drawing([], outlines(scene, screen)[0], PAINT, screen, t)
    arcs = {name: [a.form for a in picture.parts if isinstance(a.form, Arc) and a.name == name]
            for name in ("near", "far")}  # fmt: skip
    assert [a.end - a.start for a in arcs["near"]] == [2 * math.pi]
    (arc,) = arcs["far"]
    assert 3.5 < arc.end - arc.start < 6.0
    # Its ends are on the near ball's outline, in the file too.
    (path,) = [e for e in group(parsed(picture), "outlines") if e.get("data-name") == "far"]
    text = path.get("d", "")
    found_at = re.findall(r"(-?[0-9.]+),(-?[0-9.]+)", text)
    start, end = np.array(found_at, float)
    assert " 1 1 " in text  # more than half of it, towards larger angles
    for place in (start, end):
        row, column = round(float(place[1] - 0.5)), round(float(place[0] - 0.5))
        part = ring_of(near, looking)[row - 3 : row + 4, column - 3 : column + 4]
        assert part.any() and not part.all()


DEGENERATE = [
    Camera(eye=(0.3, -0.2, 2.0)),  # looks along the other camera's axis, from its eye
    Camera.look_at((0.3, 0.1, -0.4), (5.0, 0.0, 0.0)),  # from inside the ball
    Camera.look_at((1e8, 1e8, 1e8), (0.0, 0.0, 0.0)),
    Camera(eye=(0.0, 0.0, 1e-9), distance=1e-6, viewport=(-1e-7, 1e-7, -1e-7, 1e-7)),
    Camera(eye=(0.0, 0.5, 0.5), viewport=(-1e6, 1e6, -1e6, 1e6), projection="parallel"),
]


@pytest.mark.parametrize("looking", DEGENERATE)
def test_degenerate_cameras_give_a_file_without_nan(looking: Camera) -> None:
    text = svg(made(looking))
    ElementTree.fromstring(text)
    assert not re.search(r"\b(nan|inf)", text, re.IGNORECASE)
    assert not re.search(r"\d[eE][+-]?\d", re.sub(r"#[0-9a-f]{6}", "", text))
    bitmap(made(looking), (32, 24))


def test_odd_names_cannot_break_the_file() -> None:
    label = Label("l", "extra", 'a\x00b <&> "c"\ud800', np.zeros(3))
    root = parsed(made(extra=(label,)))
    assert 'ab <&> "c"' in [text.text for text in group(root, "letters")]


def test_it_is_written_whole_or_not_at_all(tmp_path: Path) -> None:
    path = tmp_path / "diagram.svg"
    count = write(path, made())
    assert path.stat().st_size == count and ElementTree.parse(path).getroot() is not None
    before = path.read_bytes()
    write(path, made())
    assert path.read_bytes() == before and list(tmp_path.iterdir()) == [path]
    with pytest.raises(LucidaError, match="does not exist"):
        write(tmp_path / "nowhere" / "diagram.svg", made())


class TestPieces:
    def test_segments_are_cut_at_the_page(self) -> None:
        points = np.array([[[-10.0, 5.0], [30.0, 5.0]], [[-9.0, -1.0], [9.0, -1.0]]])
        depth = np.array([[1.0, 5.0], [1.0, 1.0]])
        cut, deep = clipped(points, depth, (20, 10))
        assert cut.tolist() == [[[0.0, 5.0], [20.0, 5.0]]]
        assert np.allclose(deep, [[2.0, 4.0]])

    def test_a_divided_segment_is_the_whole_segment(self) -> None:
        t = np.full((10, 40), np.inf, np.float32)
        t[:, 15:25] = 1.0
        whole = np.array([[[0.0, 5.0], [40.0, 5.0]]])
        pieces, behind = divided(whole, np.array([[2.0, 2.0]]), Hidden(t, parallel=True))
        assert behind.tolist() == [False, True, False]
        assert np.allclose(pieces[:, :, 0], [[0, 16], [16, 24], [24, 40]])
        nearer = divided(whole, np.array([[0.5, 0.5]]), Hidden(t, parallel=True))
        assert nearer[1].tolist() == [False]

    def test_segments_become_chains(self) -> None:
        loop = np.array([[0, 0], [4, 0], [4, 3]], float)
        segments = np.stack([loop, np.roll(loop, -1, axis=0)], axis=1)[[2, 0, 1]]
        (chain,) = chains(segments)
        assert len(chain) == 4 and np.allclose(chain[0], chain[-1])
        star = np.array([[[0, 0], [1, 0]], [[0, 0], [0, 1]], [[0, 0], [-1, 0]]], float)
        assert len(chains(star)) == 3

    def test_dashes_are_the_parts_that_are_drawn(self) -> None:
        bent = np.array([[0.0, 0.0], [6.0, 0.0], [6.0, 6.0]])
        assert [part.tolist() for part in dashes(bent, 1.0)] == [
            [[0, 0], [5, 0]],
            [[6, 3], [6, 6]],
        ]
        assert dashes(bent, 1.4)[0].tolist() == [[0, 0], [6, 0], [6, 1]]


def test_the_bitmap_is_the_drawings_mean_in_each_pixel() -> None:
    square = Part("eye", "a", np.array([[4.0, 4], [12, 4], [12, 10], [4, 10]]), (1.0, 1.0, 1.0))
    disc = Part("eye", "b", Arc(Ellipse((24.0, 8.0), (5.0, 5.0))), (1.0, 0.0, 0.0))
    picture = bitmap(Drawing((32, 16), (0.0, 0.0, 0.0), (square, disc), 1.0), (16, 8))
    assert picture.shape == (8, 16, 3)
    assert (picture[2:5, 2:6] == 255).all() and (picture[:, :1] == 0).all()
    area = picture[:, 8:, 0].astype(float).sum() / 255 * 4
    assert area == pytest.approx(math.pi * 25, rel=0.1)


def test_a_magnified_bitmap_repeats_its_pixels() -> None:
    picture = np.arange(24, dtype=np.uint8).reshape(2, 4, 3)
    whole = magnified(picture, (8, 4), (0.0, 0.0), (1.0, 1.0))
    assert np.array_equal(whole, picture.repeat(2, axis=0).repeat(2, axis=1))
    part = magnified(picture, (4, 4), (0.25, 0.5), (0.25, 0.5))
    assert (part == picture[1, 1]).all()


def test_of_arrows_that_meet_the_nearer_one_is_over_the_other() -> None:
    eye = np.asarray(LOOKING.eye)
    start = np.zeros(3)
    near, far = 0.3 * eye, 0.3 * eye - 0.5 * np.asarray(LOOKING.w) + 0.1 * np.asarray(LOOKING.u)
    arrows = [Arrow("near", "u", start, near), Arrow("far", "v", start, far)]
    screen = OutsideScreen(LOOKING, SIZE, 1e-3)
    for items in (arrows, arrows[::-1]):
        picture = drawing(project(items, screen), [], PAINT, screen)
        heads = [part.name for part in picture.parts if part.name.endswith("head")]
        assert heads == ["far head", "near head"]
