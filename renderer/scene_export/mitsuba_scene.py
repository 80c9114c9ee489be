"""A scene as Mitsuba 3 reads it: XML, with meshes in PLY files.

Source: Mitsuba 3's documentation, "Plugin reference".
"""

from __future__ import annotations

import math
from collections.abc import Iterable

from renderer.camera_formats.mitsuba import sensor_lines, values
from renderer.scene.cancelling import check_cancelled
from renderer.scene.flat import flatten
from renderer.scene.model import (
    Color,
    DirectionalLight,
    Material,
    Mesh,
    PointLight,
    SceneObject,
    Sphere,
)
from renderer.scene_export.beside import MeshFiles
from renderer.scene_export.checkers import with_checker_uv
from renderer.scene_export.materials import (
    Microfacets,
    light_strengths,
    mean_of_pattern,
    microfacets,
    note_highlights,
    note_surface,
    note_surroundings,
    note_texture,
    reflectance,
)
from renderer.scene_export.meshes import triangles
from renderer.scene_export.places import farthest, note_far
from renderer.scene_export.what import Exported, ExportSubject, LeftOut, called

SAMPLES = 64  # a pixel


def write(subject: ExportSubject) -> Exported:
    """Raises LucidaError for a camera that Mitsuba cannot hold."""
    scene, left = subject.scene, LeftOut()
    flat = flatten(scene)
    sensor = sensor_lines(
        subject.camera, subject.size, farthest(flat.bounds, subject.camera) or None
    )
    sampler = f'<sampler type="independent"><integer name="sample_count" value="{SAMPLES}"/>'
    sensor.insert(-1, f"        {sampler}</sampler>")
    files = MeshFiles(subject.stem)
    body = [
        # Light that comes straight from the lights, as here without mirrors.
        '    <integrator type="path"><integer name="max_depth" value="2"/></integrator>',
        *sensor,
    ]
    for number, entry in scene.visible:
        check_cancelled()
        body += _object(number, entry, files, left)
    for light, strength in zip(scene.lights, light_strengths(scene, flat, left), strict=True):
        body += _light(light, strength)
    if any(scene.ambient):
        ambient = _rgb("radiance", scene.ambient)
        body.append(f'    <emitter type="constant">{ambient}</emitter>')
    note_surroundings(scene, left)
    note_far(flat.bounds, left)
    note_highlights(scene, left)
    lines = [
        '<?xml version="1.0" encoding="utf-8"?>',
        *_comment([f"{scene.name or 'A scene'}, written by Lucida", *_told(left.lines)]),
        '<scene version="3.0.0">',
        *body,
        "</scene>",
        "",
    ]
    return Exported("\n".join(lines).encode(), files.contents, left.lines)


def _told(lines: tuple[str, ...]) -> list[str]:
    return ["Not as it is there:", *(f"  {line}" for line in lines)] if lines else []


def _comment(lines: list[str]) -> list[str]:
    """As an XML comment, in which no two hyphens may stand."""
    return ["<!--", *(f"    {_sayable(line)}" for line in lines), "-->"]


def _sayable(line: str) -> str:
    return line.replace("--", "- -").rstrip("-")


def _object(number: int, entry: SceneObject, files: MeshFiles, left: LeftOut) -> list[str]:
    shape, material, name = entry.shape, entry.material, called("object", number, entry.name)
    material = note_surface(material, name, left)
    of_vertices = isinstance(shape, Mesh) and shape.colors is not None
    made = None
    if material.checker is not None and isinstance(shape, Mesh) and not of_vertices:
        made = with_checker_uv(triangles(shape), material.checker)
    if material.checker is not None and made is None:
        left.add(
            f"checker of {name}",
            "mitsuba has one of texture coordinates only, which fit faces along the object's axes; "
            "the mean of its colours was written",
        )
    note_texture(material, name, left)
    diffuse = reflectance(mean_of_pattern(material), name, left)
    if made is not None:
        diffuse_lines = _checkerboard(material, name, left)
    elif of_vertices:
        diffuse_lines = [
            '<texture type="mesh_attribute" name="NAME">'
            '<string name="name" value="vertex_color"/></texture>'
        ]
    else:
        diffuse_lines = [_rgb("NAME", diffuse)]
    if isinstance(shape, Sphere):
        kind, lines = "sphere", [_xyz("point", "center", shape.center)]
        lines.append(f'<float name="radius" value="{shape.radius!r}"/>')
    else:
        from xml.sax.saxutils import quoteattr  # here: it loads all that asks the network

        file = quoteattr(files.file_of(shape, entry.name, diffuse, made))
        place = f'<matrix value="{values(shape.transform)}"/>'
        kind, lines = "ply", [f'<string name="filename" value={file}/>']
        lines.append(f'<transform name="to_world">{place}</transform>')
        if shape.normals is None:
            lines.append('<boolean name="face_normals" value="true"/>')
    found = microfacets(material)
    if found is not None and of_vertices and max(found.f0) - min(found.f0) > 1e-3:
        left.add(
            f"highlight of {name}", "it has no colour over vertices' own; its strongest was written"
        )
    bsdf = _bsdf(found, diffuse_lines, of_vertices)
    return [
        *([f"    <!-- {_sayable(entry.name)} -->"] if entry.name else []),
        f'    <shape type="{kind}" id="object-{number}">',
        *(f"        {line}" for line in [*lines, *bsdf]),
        "    </shape>",
    ]


def _bsdf(found: Microfacets | None, diffuse: list[str], of_vertices: bool) -> list[str]:
    """A material's XML. diffuse: its colour's, with NAME for the parameter's name. of_vertices: it
    is the vertices' own, which roughplastic does not take: it wants its colours' mean."""
    if found is None:
        kind, name, inner = "diffuse", "reflectance", []
    elif of_vertices:
        kind, name = "principled", "base_color"
        inner = [
            f'<float name="roughness" value="{math.sqrt(found.alpha)!r}"/>',
            f'<float name="eta" value="{found.eta!r}"/>',
        ]
    else:
        kind, name = "roughplastic", "diffuse_reflectance"
        inner = [
            '<string name="distribution" value="ggx"/>',
            f'<float name="alpha" value="{found.alpha!r}"/>',
            f'<float name="int_ior" value="{found.eta!r}"/>',
            '<float name="ext_ior" value="1.0"/>',
            _rgb("specular_reflectance", [part / found.strongest for part in found.f0]),
        ]
    inner = [line.replace("NAME", name) for line in diffuse] + inner
    return [
        '<bsdf type="twosided">',
        f'    <bsdf type="{kind}">',
        *(f"        {line}" for line in inner),
        "    </bsdf>",
        "</bsdf>",
    ]


def _checkerboard(material: Material, name: str, left: LeftOut) -> list[str]:
    assert material.checker is not None
    return [
        '<texture type="checkerboard" name="NAME">',
        "    " + _rgb("color0", reflectance(material.diffuse, name, left)),
        "    " + _rgb("color1", reflectance(material.checker.diffuse, name, left)),
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
