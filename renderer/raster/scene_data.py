"""A scene on the GPU: its tables, and the draw calls of both passes.

SceneData owns the scene's buffers and textures, including those for the last camera. The numbers
come from setup.py; shaders/ uses them.
"""

from __future__ import annotations

from collections.abc import Sequence

import moderngl
import numpy as np

from lucida.renderer.camera.checks import Floats
from lucida.renderer.images.shared_numbers import OBJECT_TEXELS, SPHERE_TEXELS
from lucida.renderer.scene.flat import FlatScene

from .lens_targets import Lookup
from .prepared import Prepared
from .programs import UNITS, Programs, set_uniform
from .resources import Owner, check
from .setup import (
    CAMERA_BLOCK,
    RasterView,
    camera_block,
    image_space,
    light_rows,
    object_rows,
    plane_bases,
    sphere_rows,
    triangle_rows,
)
from .tables import TABLE_WIDTH, Table

BOX_VERTICES = 36
MARGIN = 1024  # pixels around the image, or half its size; Mesa 22.3 loses triangles with 4096


class SceneData:
    """One scene in one context, which must be current. Raises LucidaError if it does not fit."""

    def __init__(self, context: moderngl.Context, programs: Programs, scene: Prepared) -> None:
        self._context = context
        self._programs = programs
        self._flat, self._setup = scene
        self._last: RasterView | None = None
        self._bases: Floats | None = None  # the camera's, see plane_bases()
        self._margin = 0, 0  # the image's, see _margin_of()
        # The view of the triangles in the table, the number of its valid rows, and stale ranges.
        self._camera: RasterView | None = None
        self._rows = 0
        self._moved: list[tuple[int, int]] = []
        self._owner = Owner()
        try:
            self._build_tables()
            self._build_arrays()
            check(context, "the scene")
        except BaseException:
            self.release()
            raise

    def follows(self, scene: Prepared, same: Sequence[int]) -> bool:
        """Change to another scene if it has the same arrays, and only transforms, materials and
        lights differ.

        same: the result of same_places(). Uploads the changes. Returns False, without a change, if
        the scenes differ more.
        """
        flat, old = scene.flat, self._flat
        layout = "vertices", "colors", "faces", "object_sphere", "uv", "textures", "texels"
        if any(getattr(flat, name) is not getattr(old, name) for name in layout):
            return False
        if len(flat.lights) != len(old.lights):
            return False
        moved = [number for number, was in enumerate(same) if was != number]
        moved += np.flatnonzero(flat.single_sided != old.single_sided).tolist()
        moved = [number for number in set(moved) if flat.object_faces[number, 1]]
        if flat.normals is not old.normals:
            vertices = self._tables["vertices"]
            texels = vertices.texels[: vertices.count].reshape(len(flat.vertices), 3, -1)
            for number in moved:
                first, count = flat.object_vertices[number]
                texels[first : first + count, 1] = flat.normals[first : first + count]
                low, high = 3 * first // TABLE_WIDTH, -(-3 * (first + count) // TABLE_WIDTH)
                vertices.write_rows(low, high)
        for number in moved:
            first, count = map(int, flat.object_faces[number])
            self._moved.append((first, first + count))
        self._flat, self._setup = scene
        self._camera, self._last = self._last or self._camera, None
        self._chosen.clear()
        return True

    def _build_tables(self) -> None:
        flat = self._flat
        triangles, spheres, objects = len(flat.faces), len(flat.spheres), len(flat.materials)
        changing = {
            "triangle_rows": np.zeros((triangles, 4), np.float32),
            "spheres": np.zeros((spheres, SPHERE_TEXELS, 4), np.float32),
            "objects": np.zeros((objects, OBJECT_TEXELS, 4), np.float32),
            "lights": np.zeros(flat.lights.shape, np.float32),
        }
        fixed = {
            "faces": np.concatenate([flat.faces, flat.face_object[:, None]], axis=1),
            "vertices": np.stack([flat.vertices, flat.normals, flat.colors], axis=1),
        }
        if len(flat.texels):
            fixed |= {
                "texels": flat.texels[:, None],
                "textures": flat.textures,
                "uv": flat.uv,
            }
        self._tables = {
            name: self._owner.own(Table(self._context, name, array))
            for name, array in (changing | fixed).items()
        }

    def _build_arrays(self) -> None:
        context, flat, own = self._context, self._flat, self._owner.own
        self._block = own(context.buffer(reserve=CAMERA_BLOCK.itemsize))
        self._content: list[tuple[moderngl.Buffer, str, str]] = []
        if len(flat.faces):
            vertices = own(context.buffer(flat.vertices))
            objects = own(context.buffer(self._setup.vertex_object))
            self._content = [(vertices, "3f4", "vertex"), (objects, "1i4", "object")]
            self._indices = own(context.buffer(flat.faces))
        self._arrays: dict[moderngl.Program, moderngl.VertexArray] = {}
        # Programs by name and by the scene's features, which a rotated object may change.
        self._chosen: dict[tuple[object, ...], moderngl.Program] = {}

    def _array(self, name: str, *features: bool) -> moderngl.VertexArray:
        """Return the vertex array for one of Programs' methods that take the scene."""
        key = (name, *features)
        if key not in self._chosen:
            self._chosen[key] = getattr(self._programs, name)(self._flat, *features)
        return self._array_of(self._chosen[key], has_content=name == "triangles")

    def _array_of(
        self, program: moderngl.Program, has_content: bool = False
    ) -> moderngl.VertexArray:
        if program not in self._arrays:
            context = self._context
            set_uniform(program, "triangle_count", self.triangles)  # programs are shared by scenes
            self._arrays[program] = self._owner.own(
                context.vertex_array(program, self._content, self._indices, index_element_size=4)
                if has_content
                else context.vertex_array(program, [])
            )
        return self._arrays[program]

    def release(self) -> None:
        self._owner.release()

    @property
    def triangles(self) -> int:
        return len(self._flat.faces)

    def _margin_of(self, size: tuple[int, int]) -> tuple[int, int]:
        """Return the number of pixels by which the viewport extends beyond the image on each side.

        GL clips in float32, and the edges made by clipping must be outside the image. Their error
        is about 2^-24 of a triangle's size, which the margin exceeds even for a vast plain in a
        narrow view.
        """
        largest = self._context.info["GL_MAX_VIEWPORT_DIMS"]
        width, height = (
            max(0, min(max(side // 2 + 1, MARGIN), (most - side) // 2))
            for side, most in zip(size, largest, strict=True)
        )
        return width, height

    @property
    def flat(self) -> FlatScene:
        return self._flat

    def set_view(self, view: RasterView) -> None:
        """Fill the tables that depend on the camera, unless they are already this camera's."""
        if self._last == view:
            return
        camera, size = view.camera, view.size
        self._last, before = None, self._camera
        flat, tables = self._flat, self._tables
        space = image_space(camera, size, flat, self._setup)
        objects = object_rows(flat, self._setup, space)
        self._margin = margin = self._margin_of(size)
        self._block.write(camera_block(view, margin, space, flat))
        tables["objects"].write(objects)
        tables["lights"].write(light_rows(flat, space))
        if len(flat.spheres):
            tables["spheres"].write(sphere_rows(flat, space, objects))
        self._last, self._bases = view, plane_bases(flat, self._setup, space)
        filled, self._rows = self._rows if before == self._last else 0, 0
        for first, last in self._moved if filled else ():
            low, high = first // TABLE_WIDTH, min(-(-last // TABLE_WIDTH), filled)
            self._write_triangles(low, high)
        self._camera, self._rows, self._moved = self._last, filled, []

    def see(self) -> None:
        """Run the first pass: draw each pixel's nearest primitive into the bound framebuffer."""
        context, view = self._context, self._last
        assert view is not None, "set_view() comes first"
        (width, height), (x, y) = view.size, self._margin
        self._fill_triangles()
        context.viewport = -x, -y, width + 2 * x, height + 2 * y
        self.clear()
        context.enable_only(moderngl.DEPTH_TEST)
        context.depth_func = "<"
        has_lens = view.face is not None
        if len(self._flat.faces):
            triangles = self._array("triangles", has_lens)
            triangles.render(moderngl.TRIANGLES, vertices=3 * len(self._flat.faces))
        if len(self._flat.spheres):
            array = self._array_of(self._programs.spheres(has_lens))
            context.enable_only(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
            # Draw far sides only. The image is flipped, and a left-handed basis flips it again.
            context.front_face = "cw" if view.camera.determinant > 0 else "ccw"
            context.cull_face = "front"
            spheres = len(self._flat.spheres)
            array.render(moderngl.TRIANGLES, vertices=BOX_VERTICES, instances=spheres)

    def clear(self) -> None:
        """Clear the bound framebuffer to no primitive."""
        self._context.enable_only(moderngl.DEPTH_TEST)
        self._cover(self._array_of(self._programs.clear), "1")

    def shade(self, primitives: moderngl.Texture, face: Lookup | None = None) -> None:
        """Run the second pass: draw the hit and colour of each pixel into the bound framebuffer.

        Its depth selects the pixels: no hit is computed where the first pass has drawn nothing.
        face: restricts drawing to pixels that looked up their primitive in it.
        """
        self.draw_background()
        if not len(self._flat.materials):
            return
        self._use(primitives, face)
        self._fill_triangles()  # another camera may have been set since
        array = self._array("shade", face is not None)
        self._cover(array, ">", face)

    def draw_background(self) -> None:
        """Draw the background at the pixels where the first pass has drawn nothing."""
        self._context.enable_only(moderngl.DEPTH_TEST)
        self._cover(self._array_of(self._programs.background), "==")

    def look_up(self, primitives: moderngl.Texture, face: Lookup) -> None:
        """Draw the primitives that pixels look up in a face into the bound framebuffer."""
        self._context.enable_only(moderngl.DEPTH_TEST)
        self._use(primitives, face)
        self._cover(self._array_of(self._programs.lookup()), "1", face)

    def _use(self, primitives: moderngl.Texture, face: Lookup | None) -> None:
        primitives.use(UNITS["primitives"])
        if face is not None:
            face.positions.use(UNITS["positions"])

    def bind(self) -> None:
        """Bind the inputs of both passes. Call this before either."""
        self._block.bind_to_uniform_block(0)
        for name, table in self._tables.items():
            table.texture.use(UNITS[name])

    def _fill_triangles(self) -> None:
        """Fill the table of triangles for this camera."""
        wanted = -(-len(self._flat.faces) // TABLE_WIDTH)
        if wanted <= self._rows:
            return
        self._write_triangles(self._rows, wanted)
        self._rows = wanted

    def _write_triangles(self, low: int, high: int) -> None:
        """Write the rows of that table from low up to high."""
        if low >= high:
            return
        assert self._last is not None
        assert self._bases is not None
        table, first = self._tables["triangle_rows"], low * TABLE_WIDTH
        rows = table.texels[first : min(high * TABLE_WIDTH, len(self._flat.faces)), :3]
        is_parallel = self._last[0].is_parallel
        triangle_rows(self._flat, self._setup, self._bases, is_parallel, rows, first)
        table.write_rows(low, high)

    def _cover(
        self,
        array: moderngl.VertexArray,
        depth_func: str,
        face: Lookup | None = None,
    ) -> None:
        self._context.depth_func = depth_func
        if face is not None:
            set_uniform(array.program, "face", face.number)
        array.render(moderngl.TRIANGLES, vertices=3)
