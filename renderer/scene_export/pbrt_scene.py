"""A scene for pbrt-v4, with meshes in PLY files.

Source: pbrt-v4's documentation, "pbrt-v4 Input File Format".
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from renderer.camera_formats.pbrt import camera_lines, listed_by_columns, numbers
from renderer.scene.cancelling import check_cancelled
from renderer.scene.flat import FlatScene, flatten
from renderer.scene.model import Color, DirectionalLight, Mesh, PointLight, SceneObject, Sphere
from renderer.scene.texture import Texture
from renderer.scene_export.materials import (
    Tiling,
    light_strengths,
    microfacets,
    note_far,
    note_highlights,
    note_shadows,
    note_surface,
    note_surroundings,
    picture_bytes,
    product,
    reflectance,
    tiling,
)
from renderer.scene_export.meshes import Triangles, arrays_of, is_mirrored, ply_bytes, wound
from renderer.scene_export.what import Exported, ExportSubject, FilesBeside, LeftOut, called

SAMPLES = 64  # per pixel


def write(subject: ExportSubject) -> Exported:
    """Return a scene for pbrt. Raises LucidaError for a camera that pbrt cannot hold."""
    scene, left = subject.scene, LeftOut()
    flat = flatten(scene)
    camera = camera_lines(subject.camera, subject.size, _quotable(f"{subject.stem}.exr"))
    files = FilesBeside(_quotable(subject.stem))
    body: list[str] = []
    for light, strength in zip(scene.lights, light_strengths(scene, flat, left), strict=True):
        body.append(_light(light, strength))
    if any(scene.ambient):
        body.append(f'LightSource "infinite" "rgb L" [ {numbers(scene.ambient)} ]')
    for number, entry in scene.visible:
        check_cancelled()
        body += _object(number, entry, flat, files, left)
    note_surroundings(scene, left)
    note_far(flat.bounds, left)
    note_shadows(scene, left)
    note_highlights(scene, left)
    lines = [
        *(f"# {line}" for line in [f"{scene.name or 'A scene'}, written by Lucida", *left.told]),
        *camera,
        f'Sampler "independent" "integer pixelsamples" [ {SAMPLES} ]',
        'PixelFilter "box"',
        "# Light that comes straight from the lights, as there without mirrors.",
        'Integrator "path" "integer maxdepth" [ 1 ]',
        "WorldBegin",
        *body,
        "",
    ]
    return Exported("\n".join(lines).encode(), files.contents, left.lines)


def _quotable(name: str) -> str:
    """Return a text for quotation marks, in which pbrt has few escapes."""
    return "".join("-" if sign in '"\\\n' else sign for sign in name)


def _light(light: PointLight | DirectionalLight, strength: Color) -> str:
    rgb = numbers(strength)
    if isinstance(light, PointLight):
        place = f'"point3 from" [ {numbers(light.position)} ]'
        return f'LightSource "point" {place} "rgb I" [ {rgb} ]'
    return (
        f'LightSource "distant" "point3 from" [ 0 0 0 ] '
        f'"point3 to" [ {numbers(light.direction)} ] "rgb L" [ {rgb} ]'
    )


def _object(
    number: int, entry: SceneObject, flat: FlatScene, files: FilesBeside, left: LeftOut
) -> list[str]:
    shape, name = entry.shape, called("object", number, entry.name)
    lines = ["AttributeBegin", *([f"    # {entry.name}"] if entry.name else [])]
    lines += [f"    {line}" for line in _material(number, entry, name, flat, files, left)]
    if isinstance(shape, Sphere):
        # pbrt's poles are on its z axis; an image begins at its x axis, here behind, at -z.
        place = np.array([[0.0, -1, 0, 0], [0, 0, 1, 0], [-1, 0, 0, 0], [0, 0, 0, 1]])
        place[:3, 3] = shape.center
        kind = f'"sphere" "float radius" [ {shape.radius!r} ]'
    else:
        place = shape.transform
        if shape.colors is not None:
            left.add(f"vertex colours of {name}", "pbrt has none; their mean was written")
        inputs = arrays_of(replace(shape, colors=None)), is_mirrored(place)
        file = files.file("meshes", "ply", entry.name, _mesh_bytes, *inputs)
        kind = f'"plymesh" "string filename" [ "{file}" ]'
    lines += [f"    Transform [ {listed_by_columns(place)} ]", f"    Shape {kind}", "AttributeEnd"]
    return lines


def _mesh_bytes(own: Triangles, mirrored: bool) -> bytes:
    return ply_bytes(wound(own), (), mirrored)


def _material(
    number: int,
    entry: SceneObject,
    name: str,
    flat: FlatScene,
    files: FilesBeside,
    left: LeftOut,
) -> list[str]:
    material, shape = note_surface(entry.material, name, left), entry.shape
    tint: Iterable[float] = (1.0, 1.0, 1.0)
    if isinstance(shape, Mesh) and shape.colors is not None:
        tint = shape.colors.mean(axis=0).tolist()
    diffuse = reflectance(product(material.diffuse, tint), name, left)
    colour, lines = f'"rgb reflectance" [ {numbers(diffuse)} ]', []
    if material.texture is not None:
        tiled = tiling(material.texture, False, name, left)
        if tiled.place[0, 1] or tiled.place[1, 0]:
            left.add(f"texture of {name}", "it is not turned there")
            tiled = tiling(replace(material.texture, rotate_deg=0.0), False, name, LeftOut())
        lines = [_texture(f"image-{number}", entry, material.texture, tiled, diffuse, files)]
        colour = f'"texture reflectance" [ "image-{number}" ]'
    if material.checker is not None:
        other = reflectance(product(material.checker.diffuse, tint), name, left)
        texture = f"checker-{number}"
        world_from_cell = np.linalg.inv(np.vstack([flat.cells[number], (0, 0, 0, 1)]))
        lines += [
            f"Transform [ {listed_by_columns(world_from_cell)} ]",
            f'Texture "{texture}" "spectrum" "checkerboard" "integer dimension" [ 3 ] '
            f'"rgb tex1" [ {numbers(diffuse)} ] "rgb tex2" [ {numbers(other)} ]',
        ]
        colour = f'"texture reflectance" [ "{texture}" ]'
    found = microfacets(material)
    if found is None:
        return [*lines, f'Material "diffuse" {colour}']
    if max(found.f0) - min(found.f0) > 1e-3:
        left.add(f"highlight of {name}", "pbrt's coats have no colour; its strongest was written")
    return [
        *lines,
        f'Material "coateddiffuse" {colour} "float roughness" [ {found.alpha!r} ] '
        f'"bool remaproughness" [ false ] "float eta" [ {found.eta!r} ]',
    ]


def _texture(
    name: str, entry: SceneObject, texture: Texture, tiled: Tiling, tint: Color, files: FilesBeside
) -> str:
    (su, _, u), (_, sv, v) = tiled.place.tolist()
    inputs = texture, tint, tiled.is_doubled
    file = files.file("textures", "png", entry.name, picture_bytes, *inputs)
    return (
        f'Texture "{name}" "spectrum" "imagemap" "string filename" [ "{file}" ] '
        f'"string wrap" [ "{tiled.wrap}" ] "float uscale" [ {su!r} ] "float vscale" [ {sv!r} ] '
        f'"float udelta" [ {u!r} ] "float vdelta" [ {v!r} ]'
    )
