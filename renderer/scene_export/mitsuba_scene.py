"""A scene for Mitsuba 3: XML, with meshes, images and highlights in separate files.

Only the lights are sampled: ambient light is therefore emitted by the surfaces, the background is
an environment, and neither lights anything. Source: Mitsuba 3's documentation, "Plugin reference".
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from renderer.camera import Camera
from renderer.camera_formats.mitsuba import sensor_lines, values
from renderer.scene.cancelling import check_cancelled
from renderer.scene.flat import flatten
from renderer.scene.model import (
    Checker,
    Color,
    DirectionalLight,
    Mesh,
    PointLight,
    SceneObject,
    Sphere,
)
from renderer.scene.texture import Texture
from renderer.scene_export.checkers import with_checker_uv
from renderer.scene_export.lobe import lobe_bytes
from renderer.scene_export.materials import (
    light_strengths,
    mean_of_pattern,
    note_far,
    note_shadows,
    note_surface,
    picture_bytes,
    product,
    reflectance,
    tiling,
)
from renderer.scene_export.meshes import (
    Triangles,
    Viewer,
    arrays_of,
    is_mirrored,
    ply_bytes,
    shows_backs,
    turned_to,
    viewer_of,
    wound,
)
from renderer.scene_export.what import Exported, ExportSubject, FilesBeside, LeftOut, called

SAMPLES = 64  # per pixel and light: each sample picks one light
# A blend's weights add up to 1, and a reflectance is at most 1, so the highlight gets a small
# weight and is brighter by the same factor.
HIGHLIGHT = 2.0**-10
# The columns of a PLY file, and Mitsuba's name for them.
DIFFUSE, AMBIENT = ("r g b", "vertex_color"), ("ambient_0 ambient_1 ambient_2", "vertex_ambient")
UNSAMPLED = '<float name="sampling_weight" value="0"/>'
BLACK = (0.0, 0.0, 0.0)


def write(subject: ExportSubject) -> Exported:
    """Return a scene as XML. Raises LucidaError for a camera that Mitsuba cannot hold."""
    scene, left = subject.scene, LeftOut()
    flat = flatten(scene)
    corners = np.array(list(itertools.product(*flat.bounds.T)))
    farthest = float(np.linalg.norm(corners - subject.camera.eye, axis=1).max())
    sensor = sensor_lines(subject.camera, subject.size, farthest or None)
    count = SAMPLES * max(len(scene.lights), 1)
    sampler = f'<sampler type="independent"><integer name="sample_count" value="{count}"/>'
    sensor.insert(-1, f"        {sampler}</sampler>")
    files = FilesBeside(subject.stem)
    body = [
        '    <integrator type="direct">',
        '        <integer name="emitter_samples" value="1"/>',
        '        <integer name="bsdf_samples" value="0"/>',
        "    </integrator>",
        *sensor,
    ]
    for number, entry in scene.visible:
        check_cancelled()
        body += _object(number, entry, subject, files, left)
    for light, strength in zip(scene.lights, light_strengths(scene, flat, left), strict=True):
        body += _light(light, strength)
    if not scene.lights:  # Mitsuba needs one to sample
        body += _light(DirectionalLight((0, -1, 0)), BLACK)
    if any(scene.background):
        radiance = UNSAMPLED + _rgb("radiance", scene.background)
        body.append(f'    <emitter type="constant">{radiance}</emitter>')
    note_far(flat.bounds, left)
    note_shadows(scene, left)
    if any(any(entry.material.specular) for _, entry in scene.visible):
        left.add(
            "highlights",
            "they end where a surface turns away from its light; Mitsuba's rgb variants read them",
        )
    lines = [
        '<?xml version="1.0" encoding="utf-8"?>',
        *_comment([f"{scene.name or 'A scene'}, written by Lucida", *left.told]),
        '<scene version="3.0.0">',
        *body,
        "</scene>",
        "",
    ]
    return Exported("\n".join(lines).encode(), files.contents, left.lines)


def _comment(lines: list[str]) -> list[str]:
    """Return an XML comment, which must not contain two hyphens in a row."""
    return ["<!--", *(f"    {_sayable(line)}" for line in lines), "-->"]


def _sayable(line: str) -> str:
    return line.replace("--", "- -").rstrip("-")


def _object(
    number: int, entry: SceneObject, subject: ExportSubject, files: FilesBeside, left: LeftOut
) -> list[str]:
    shape, ambient, name = entry.shape, subject.scene.ambient, called("object", number, entry.name)
    entry = replace(entry, material=note_surface(entry.material, name, left))
    if isinstance(shape, Sphere):
        kind, checker, lines = "sphere", None, _sphere(shape, subject.camera)
    else:
        kind = "ply"
        checker, lines = _mesh(shape, entry, subject, files)
    _note_pattern(entry, name, checker, left)
    highlight = entry.material.specular if any(entry.material.specular) else None
    share = 1 / (1 - HIGHLIGHT) if highlight else 1.0
    bsdf = [
        '<bsdf type="diffuse">',
        *_indented(_pattern(entry, checker, files, "reflectance", DIFFUSE, (share,) * 3)),
        "</bsdf>",
    ]
    if highlight:
        inputs = highlight, entry.material.shininess, HIGHLIGHT
        file = files.file("highlights", "bsdf", entry.name, lobe_bytes, *inputs)
        bsdf = [
            '<bsdf type="blendbsdf">',
            f'    <float name="weight" value="{HIGHLIGHT!r}"/>',
            *_indented(bsdf),
            f'    <bsdf type="measured">{_file(file)}</bsdf>',
            "</bsdf>",
        ]
    lines += ['<bsdf type="twosided">', *_indented(bsdf), "</bsdf>"]
    if any(ambient):
        radiance = _pattern(entry, checker, files, "radiance", AMBIENT, ambient)
        lines += ['<emitter type="area">', *_indented([UNSAMPLED, *radiance]), "</emitter>"]
    return [
        *([f"    <!-- {_sayable(entry.name)} -->"] if entry.name else []),
        f'    <shape type="{kind}" id="object-{number}">',
        *_indented(_indented(lines)),
        "    </shape>",
    ]


def _indented(lines: Iterable[str]) -> list[str]:
    return [f"    {line}" for line in lines]


def _note_pattern(entry: SceneObject, name: str, checker: Checker | None, left: LeftOut) -> None:
    material = entry.material
    if material.checker is not None and checker is None:
        left.add(
            f"checker of {name}",
            "mitsuba has one of texture coordinates only, which fit faces along the object's axes; "
            "the mean of its colours was written",
        )
    if material.texture is not None:
        tiling(material.texture, True, name, left)
        if isinstance(entry.shape, Mesh) and entry.shape.colors is not None:
            why = "mitsuba multiplies no image by them; their mean was written"
            left.add(f"vertex colours of {name}", why)
    for color in (material.diffuse, material.checker and material.checker.diffuse):
        reflectance(color or BLACK, name, left)


def _sphere(shape: Sphere, camera: Camera) -> list[str]:
    (x, y, z), r = shape.center, shape.radius
    # Mitsuba's poles are on its z axis; an image begins at its x axis, here behind, at -z.
    place = np.array([[0, -r, 0, x], [0, 0, r, y], [-r, 0, 0, z], [0, 0, 0, 1]])
    lines = [f'<transform name="to_world"><matrix value="{values(place)}"/></transform>']
    if math.dist(shape.center, camera.eye) < r:
        lines.append('<boolean name="flip_normals" value="true"/>')
    return lines


def _mesh(
    shape: Mesh, entry: SceneObject, subject: ExportSubject, files: FilesBeside
) -> tuple[Checker | None, list[str]]:
    """Return the checker for which the mesh gets texture coordinates, and its XML."""
    own, material, ambient = arrays_of(shape), entry.material, subject.scene.ambient
    mesh = wound(own)
    checker = material.checker if shape.colors is None else None
    if checker is not None and with_checker_uv(mesh, checker) is None:
        checker = None
    # A surface emits only from its front; a mesh that shows its back gets a file for this camera.
    viewer = viewer_of(subject.camera, shape.transform) if any(ambient) else None
    if viewer is not None and not shows_backs(viewer, mesh):
        viewer = None
    tints: tuple[tuple[str, Color], ...] = ()
    if shape.colors is not None and material.texture is None:
        color, share = mean_of_pattern(material), 1 / (1 - HIGHLIGHT * any(material.specular))
        tints = ((DIFFUSE[0], product(color, (share,) * 3)),)
        if any(ambient):
            tints += ((AMBIENT[0], product(color, ambient)),)
    inputs = own, checker, viewer, tints, is_mirrored(shape.transform)
    lines = [
        _file(files.file("meshes", "ply", entry.name, _mesh_bytes, *inputs)),
        f'<transform name="to_world"><matrix value="{values(shape.transform)}"/></transform>',
    ]
    if shape.normals is None:
        lines.append('<boolean name="face_normals" value="true"/>')
    return checker, lines


def _mesh_bytes(
    own: Triangles,
    checker: Checker | None,
    viewer: Viewer | None,
    tints: tuple[tuple[str, Color], ...],
    mirrored: bool,
) -> bytes:
    mesh = wound(own)
    if checker is not None:
        mesh = with_checker_uv(mesh, checker) or mesh
    return ply_bytes(turned_to(viewer, mesh) if viewer else mesh, tints, mirrored)


def _pattern(
    entry: SceneObject,
    checker: Checker | None,
    files: FilesBeside,
    name: str,
    vertices: tuple[str, str],
    factor: Color,
) -> list[str]:
    """Return a colour's XML: the diffuse colour times a factor, with its pattern.

    vertices: the attribute of the vertices' own colours, times that factor.
    """
    material, colors = entry.material, getattr(entry.shape, "colors", None)

    def shown(color: Color) -> Color:
        red, green, blue = product(color, factor)
        if name == "reflectance":
            red, green, blue = min(red, 1.0), min(green, 1.0), min(blue, 1.0)
        return red, green, blue

    if material.texture is not None:
        tint = product(material.diffuse, factor)
        if colors is not None:
            tint = product(tint, colors.mean(axis=0).tolist())
        return _bitmap(entry, material.texture, name, tint, files)
    if checker is not None:
        return [
            f'<texture type="checkerboard" name="{name}">',
            f"    {_rgb('color0', shown(material.diffuse))}",
            f"    {_rgb('color1', shown(checker.diffuse))}",
            "</texture>",
        ]
    if colors is not None:
        attribute = f'<string name="name" value="{vertices[1]}"/>'
        return [f'<texture type="mesh_attribute" name="{name}">{attribute}</texture>']
    return [_rgb(name, shown(mean_of_pattern(material)))]


def _bitmap(
    entry: SceneObject, texture: Texture, name: str, tint: Color, files: FilesBeside
) -> list[str]:
    tiled = tiling(texture, True, "", LeftOut())
    down = np.array([[1, 0, 0, 0], [0, -1, 0, 1], [0, 0, 1, 0], [0, 0, 0, 1.0]])
    # Mitsuba counts v from the image's upper edge downwards, on its own sphere too.
    place = np.eye(4)
    place[:2, [0, 1, 3]] = tiled.place
    place = down @ place
    if isinstance(entry.shape, Sphere):
        place = place @ down
    file = files.file("textures", "png", entry.name, picture_bytes, texture, tint, tiled.is_doubled)
    return [
        f'<texture type="bitmap" name="{name}">',
        f"    {_file(file)}",
        f'    <string name="wrap_mode" value="{tiled.wrap}"/>',
        f'    <transform name="to_uv"><matrix value="{values(place)}"/></transform>',
        "</texture>",
    ]


def _light(light: PointLight | DirectionalLight, strength: Color) -> list[str]:
    if isinstance(light, PointLight):
        kind, place = "point", _xyz("point", "position", light.position)
        strong = _rgb("intensity", strength)
    else:
        kind, place = "directional", _xyz("vector", "direction", light.direction)
        strong = _rgb("irradiance", strength)
    return [f'    <emitter type="{kind}">{place}{strong}</emitter>']


def _xyz(kind: str, name: str, value: Iterable[float]) -> str:
    x, y, z = value
    return f'<{kind} name="{name}" x="{x!r}" y="{y!r}" z="{z!r}"/>'


def _rgb(name: str, color: Iterable[float]) -> str:
    return f'<rgb name="{name}" value="{", ".join(map(repr, map(float, color)))}"/>'


def _file(path: str) -> str:
    from xml.sax.saxutils import quoteattr  # imported late: it loads the network modules

    return f'<string name="filename" value={quoteattr(path)}/>'
