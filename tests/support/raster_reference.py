"""What any renderer must give, computed in float64 by trying every primitive for every pixel.

Written from the shading model's text, without looking at a renderer: slow, short, exact.
"""

import numpy as np

from renderer.frame import Frame
from renderer.scene.flat import flatten
from renderer.scene.positions import world_vertices


def reference(scene, camera, size):
    """A Frame with every channel."""
    flat = flatten(scene)
    origin, direction = (array.reshape(-1, 3) for array in camera.rays(size))
    count = len(origin)
    t = np.full(count, np.inf)
    primitive = np.full(count, -1, np.int32)
    t_min, t_max = camera.t_range
    with np.errstate(all="ignore"):
        for number, hits in enumerate(candidates(flat, origin, direction)):
            for hit in hits:
                nearer = (hit > t_min) & (hit < t_max) & (hit < t)
                t[nearer], primitive[nearer] = hit[nearer], number
    color = np.tile(flat.background.astype(float), (count, 1))
    normal = np.zeros((count, 3))
    seen = np.flatnonzero(primitive >= 0)
    if len(seen):
        args = flat, origin[seen], direction[seen], t[seen], primitive[seen]
        color[seen], normal[seen] = shade(*args)
    owners = np.concatenate([flat.face_object, flat.sphere_object, [-1]]).astype(np.int32)
    image = size[1], size[0]
    return Frame(
        size=size,
        color=color.reshape(*image, 3).astype(np.float32),
        depth=t.reshape(image).astype(np.float32),
        normal=normal.reshape(*image, 3).astype(np.float32),
        id=owners[primitive].reshape(image),
        primitive=primitive.reshape(image),
    )


def candidates(flat, o, d):
    """For each primitive, the ray parameters of its hits, NaN where there is none."""
    corners = world_vertices(flat)[flat.faces]
    for a, b, c in corners:
        t, b1, b2 = triangle_hit(a, b, c, o, d)
        inside = (b1 >= 0) & (b2 >= 0) & (b1 + b2 <= 1)
        yield (np.where(inside, t, np.nan),)
    for x, y, z, radius in flat.spheres:
        f = o - (x, y, z)
        square, middle = dot(d, d), -dot(f, d) / dot(d, d)
        off = f + middle[:, None] * d
        half = np.sqrt((radius**2 - dot(off, off)) / square)
        yield middle - half, middle + half


def triangle_hit(a, b, c, o, d):
    """t and two barycentrics of rays with a triangle's plane, by Cramer's rule."""
    e1, e2, s = b - a, c - a, o - a
    p, q = np.cross(d, e2), np.cross(s, e1)
    det = dot(p, e1)
    return dot(q, e2) / det, dot(p, s) / det, dot(q, d) / det


def shade(flat, o, d, t, primitive):
    """Colour and normal of hits; (n, 3) each."""
    point = o + t[:, None] * d
    toward = unit(d)
    triangles = len(flat.faces)
    geometric, smooth = np.zeros_like(d), np.zeros_like(d)
    tint = np.ones_like(d)
    vertices = world_vertices(flat)
    for k, number in enumerate(primitive):
        if number >= triangles:
            center, radius = np.split(flat.spheres[number - triangles], [3])
            geometric[k] = (point[k] - center) / radius
            continue
        face = flat.faces[number]
        a, b, c = vertices[face]
        geometric[k] = unit(np.cross(b - a, c - a))
        _, b1, b2 = triangle_hit(a, b, c, o[k], d[k])
        weights = np.array([1 - b1 - b2, b1, b2])
        tint[k] = weights @ flat.colors[face]
        normals = flat.normals[face].astype(float)
        if np.abs(normals).max(axis=1).min() > 0:
            mean = weights @ normals
            if np.linalg.norm(mean) >= 1e-6:
                smooth[k] = unit(mean) * (1 if normals.sum(0) @ geometric[k] >= -1e-5 else -1)
    side = np.where(dot(geometric, d) < 0, 1.0, -1.0)[:, None]
    geometric *= side
    flat_there = np.abs(smooth).max(axis=1, keepdims=True) == 0
    n = np.where(flat_there, geometric, smooth * side)
    away = dot(n, toward)[:, None] + 1e-3
    n = np.where(away > 0, unit(n - away * toward), n)
    owners = np.concatenate([flat.face_object, flat.sphere_object])[primitive]
    material = flat.materials[owners].astype(float)
    linear, offset = flat.cells[owners, :, :3], flat.cells[owners, :, 3]
    cell = np.einsum("nij,nj->ni", linear, point) + offset
    cell -= 1e-3 * unit(np.einsum("nij,nj->ni", linear, geometric))
    odd = np.floor(cell).sum(axis=1) % 2 == 1
    other = (odd & (material[:, 1, 3] > 0))[:, None]
    albedo = np.where(other, material[:, 2, :3], material[:, 0, :3]) * tint
    color = flat.ambient * albedo
    for (x, y, z, is_point), (r, g, b, _) in flat.lights:
        to_light = (x, y, z) - point if is_point else np.tile((x, y, z), (len(point), 1))
        away = np.linalg.norm(to_light, axis=1, keepdims=True)
        to_light = np.where(away < 1e-12, 0, to_light / np.maximum(away, 1e-30))
        half = to_light - toward
        size = np.linalg.norm(half, axis=1, keepdims=True)
        has_highlight = ((size >= 1e-6) & (away >= 1e-12))[:, 0]
        half = half / np.maximum(size, 1e-30)
        highlight = np.where(has_highlight, np.maximum(0, dot(n, half)) ** material[:, 0, 3], 0)
        lambert = np.maximum(0, dot(n, to_light))
        shine = material[:, 1, :3] * highlight[:, None]
        color = color + (r, g, b) * (albedo * lambert[:, None] + shine)
    return color, n


def dot(a, b):
    return np.einsum("...i,...i->...", *np.broadcast_arrays(a, b))


def unit(vector):
    return vector / np.linalg.norm(vector, axis=-1, keepdims=True)
