"""The live image in the diagram as SVG: where it stands, what hides it and what it hides."""

from __future__ import annotations

import base64
import io
import re
import xml.etree.ElementTree as ElementTree
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image as PngImage

from app.outside.diagram import Segments
from app.outside.frustum import pixel_corners, plane_corners
from app.outside.image_bitmap import MOST_PIXELS, standing
from app.outside.occlusion import Hidden
from app.outside.projected import project
from app.outside.screen import OutsideScreen
from app.outside.svg import svg
from app.outside.vector import Drawing, Paint, PlaneImage, drawing
from renderer.camera import Camera
from renderer.raster.overlay import plane_on_screen

SIZE = (320, 240)
SPACE = "{http://www.w3.org/2000/svg}"
CAMERA = Camera(eye=(0.3, -0.2, 2.0), viewport=(-0.8, 0.9, -0.4, 0.6), w=(0.1, 0.0, 1.0))
LOOKING = Camera.look_at((4.0, 2.5, 6.0), (0.3, 0.0, 0.0), fov_y_deg=40.0, aspect=4 / 3)
PARALLEL = Camera(
    LOOKING.eye, LOOKING.u, LOOKING.v, LOOKING.w, 1.0, (-4.0, 4.0, -3.0, 3.0), "parallel"
)
NEAR = Camera.look_at((1.5, 0.3, 2.2), (0.3, 0.1, 1.0), fov_y_deg=60.0, aspect=4 / 3)
BEHIND = Camera.look_at((-1.0, 0.8, -3.0), (0.3, 0.0, 1.0), fov_y_deg=40.0, aspect=4 / 3)
PAINT = Paint(lambda role, tint: (1.0, 0.5, 0.0), (0.7, 0.7, 0.7), (0.1, 0.1, 0.1))
DEGENERATE = [
    Camera(eye=(0.3, -0.2, 2.0)),  # looks along the other camera's axis, from its eye
    Camera.look_at((0.3, 0.1, 0.9), (0.3, 0.0, 1.2)),  # the plane goes through its eye, almost
    Camera.look_at((1e8, 1e8, 1e8), (0.0, 0.0, 0.0)),
    Camera(eye=(0.0, 0.5, 0.5), viewport=(-1e6, 1e6, -1e6, 1e6), projection="parallel"),
]


class TestLiveImage:
    """The picture on the image plane, in the file."""

    PIXELS = (12, 16)  # rows, columns

    def image(self, looking: Camera, size: tuple[int, int] = SIZE) -> PlaneImage:
        rows, columns = np.mgrid[0 : self.PIXELS[0], 0 : self.PIXELS[1]]
        pixels = np.stack([10 * rows, 10 * columns, 0 * rows], axis=-1).astype(np.uint8)
        corners = plane_corners(CAMERA)[[0, 1, 3]]
        plane = plane_on_screen(looking, size, corners, np.asarray(CAMERA.eye))
        assert plane is not None
        return PlaneImage(pixels, plane, 0.9)

    def drawn(
        self, looking: Camera, t: NDArray[np.float32] | None = None, extra: Any = ()
    ) -> Drawing:
        screen = OutsideScreen(looking, SIZE, 1e-3)
        return drawing(project(extra, screen), [], PAINT, screen, t, image=self.image(looking))

    @pytest.mark.parametrize("looking", [LOOKING, PARALLEL, NEAR, BEHIND])
    def test_each_pixel_is_where_its_viewing_ray_meets_the_plane(self, looking: Camera) -> None:
        stands = self.drawn(looking).standing
        assert stands is not None
        assert len(stands.cells) == 1 or not looking.is_parallel
        height, width = self.PIXELS
        for i, j in ((0, 0), (5, 8), (11, 15), (2, 13)):
            met = 0
            row, column, _ = looking.project(pixel_corners(CAMERA, (i, j), (width, height)), SIZE)
            wanted = np.array([column.mean() + 0.5, row.mean() + 0.5])
            for cell in stands.cells:
                a, b, c, d, e, f = cell.matrix
                at = np.array(
                    [a * (j + 0.5) + c * (i + 0.5) + e, b * (j + 0.5) + d * (i + 0.5) + f]
                )
                if _inside(at, cell.corners):
                    assert np.abs(at - wanted).max() < 0.3
                    met += 1
            on_page = ((wanted > 0) & (wanted < SIZE)).all()
            assert met or not on_page

    def test_the_file_has_it_once_and_it_can_be_read_back(self) -> None:
        picture = self.drawn(LOOKING)
        root = ElementTree.fromstring(svg(picture))
        (found,) = root.iter(f"{SPACE}image")
        link = found.get("{http://www.w3.org/1999/xlink}href") or ""
        head, content = link.split(",")
        assert head == "data:image/png;base64"
        assert found.get("image-rendering") == "optimizeSpeed"  # pixels stay squares
        assert found.get("style") == "image-rendering:pixelated"
        with PngImage.open(io.BytesIO(base64.b64decode(content))) as file:
            rgba = np.asarray(file)
        assert (rgba[..., 3] == 255).all()
        assert (rgba[..., 0] == 10 * np.arange(self.PIXELS[0])[:, None]).all()
        (cells,) = [part for part in root.iter(f"{SPACE}g") if part.get("id") == "live-image"]
        assert cells.get("opacity") == "0.9"
        assert picture.standing is not None
        assert len(cells) == len(picture.standing.cells) == len(list(root.iter(f"{SPACE}clipPath")))

    def test_what_stands_before_it_is_cut_out_and_what_is_behind_it_is_not(self) -> None:
        middle = plane_corners(CAMERA).mean(axis=0)
        row, column, t = (float(part) for part in LOOKING.project(middle, SIZE))
        for depth, covered in ((0.8 * t, True), (1.3 * t, False)):
            scene = np.full((SIZE[1], SIZE[0]), np.inf, np.float32)
            scene[:, : round(column)] = depth  # left of the middle
            stands = self.drawn(LOOKING, scene).standing
            assert stands is not None
            shown = stands.rgba[self.PIXELS[0] // 2, :, 3] == 255
            assert shown[-1] and shown[0] != covered
            assert row > 0

    def test_it_hides_lines_behind_it_but_not_its_own(self) -> None:
        corners = plane_corners(CAMERA)
        middle, across = corners.mean(axis=0), 0.2 * (corners[1] - corners[0])
        away = middle - np.asarray(LOOKING.eye)
        for shift, on_plane, behind in ((-0.1, False, False), (0.1, False, True), (0, True, False)):
            center = middle + shift * away
            ends = np.array([[center - across, center + across]])
            line = Segments("l", "extra", ends, hidden=0.3, on_plane=on_plane)
            parts = self.drawn(LOOKING, extra=[line]).parts
            assert [(p.dashed, p.opacity) for p in parts] == [(behind, 0.3 if behind else 1.0)]

    @pytest.mark.parametrize("looking", DEGENERATE)
    def test_degenerate_cameras(self, looking: Camera) -> None:
        corners = plane_corners(CAMERA)[[0, 1, 3]]
        plane = plane_on_screen(looking, SIZE, corners, np.asarray(CAMERA.eye))
        if plane is None:  # edge on: there is nothing to stand
            return
        image = PlaneImage(np.zeros((4, 4, 3), np.uint8), plane, 0.9)
        picture = drawing([], [], PAINT, OutsideScreen(looking, SIZE), image=image)
        text = svg(picture)
        ElementTree.fromstring(text)
        assert not re.search(r"\b(nan|inf)", re.sub('base64,[^"]*', "", text), re.IGNORECASE)

    def test_a_vast_image_is_made_smaller(self) -> None:
        image = self.image(LOOKING)
        pixels = np.repeat(np.repeat(image.pixels, 200, axis=0), 200, axis=1)
        hidden = Hidden(None, False)
        stands = standing(pixels, image.plane, SIZE, hidden, 0.9)
        assert stands is not None
        assert stands.rgba.shape[0] * stands.rgba.shape[1] <= MOST_PIXELS
        assert np.abs(stands.rgba[-1, -1, :3].astype(int) - pixels[-1, -1]).max() <= 1


def _inside(at: NDArray[np.float64], ring: NDArray[np.float64]) -> bool:
    """Return True if a point is in a convex polygon, of either orientation."""
    along, away = np.roll(ring, -1, axis=0) - ring, at - ring
    sides = along[:, 0] * away[:, 1] - along[:, 1] * away[:, 0]
    return bool((sides >= 0).all() or (sides <= 0).all())
