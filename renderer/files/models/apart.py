"""Divide a part of a model whose connected pieces are too far apart for one float32 origin."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lucida.renderer.files.models.parts import FAR, Part, own_origin
from lucida.renderer.files.texture_images import ModelImages, shown
from lucida.renderer.scene.normals import components

MOST = 256  # cells of a part with an origin of their own
SHORT = 8.0  # up to here float32 holds all digits of numbers with six decimals


def parts_apart(part: Part, images: ModelImages) -> list[Part]:
    """Return the part, or several: first the connected pieces that may share its origin, then those
    of each cell of space that are so small that they need an origin in the cell.

    images: notes that there are too many cells; they are enlarged until there are not.
    A coordinate that is at most FAR + 1/2 times a piece's size loses less than 1e-6 of that size in
    float32. Faults of a part are left to build_mesh().
    """
    vertices, faces = np.asarray(part.vertices, np.float64), np.asarray(part.faces, np.int64)
    if not len(faces) or faces.min() < 0 or faces.max() >= len(vertices):
        return [part]
    with np.errstate(all="ignore"):
        if (vertices == vertices.astype(np.float32)).all():  # as in most binary files
            return [part]
        if np.abs(vertices).max() <= SHORT and (vertices == np.round(vertices, 6)).all():
            return [part]
        origin = own_origin(vertices, faces)
        near = vertices - origin
    begin, end = faces[:, :2].ravel(), faces[:, 1:].ravel()
    for has_places in (False, True):
        if has_places:  # join vertices at one place, too, which takes longer
            order = np.lexsort(near.T)
            same = (near[order[1:]] == near[order[:-1]]).all(axis=1)
            begin, end = np.append(begin, order[1:][same]), np.append(end, order[:-1][same])
        label = components(len(near), begin, end)
        order = np.argsort(label, kind="stable")
        starts = np.flatnonzero(np.diff(label[order], prepend=-1))
        low, high = (f.reduceat(near[order], starts) for f in (np.minimum, np.maximum))
        size = (high - low).max(axis=1)
        size[size == 0] = np.inf  # such as a vertex that no face uses
        away = np.maximum(-low, high).max(axis=1) / size  # of the farthest coordinate
        if not (away > FAR + 0.5).any():
            return [replace(part, origin=origin)]
    far, side = FAR, 2 * FAR * 2.0 ** np.floor(np.log2(size))
    while True:
        coarse = away > far + 0.5
        sides = side[coarse, None] * (far / FAR)
        centers = (np.floor((low + high)[coarse] / (2 * sides)) + 0.5) * sides
        cells, number = np.unique(np.hstack([centers, sides]), axis=0, return_inverse=True)
        if len(cells) <= MOST:
            break
        far *= 4
    if far > FAR:
        many = f"{shown(part.name)} has too many small pieces far apart"
        lost = far * np.finfo(np.float32).eps / 2
        images.note(f"{many}; coordinates lose up to {lost:.2g} of a piece's size", "shapes")
    cell = np.zeros(len(near), np.int64)
    cell[label[order[starts[coarse]]]] = number.ravel() + 1
    cell = cell[label[faces[:, 0]]]
    found = []
    for k in np.unique(cell).tolist():
        which, own = cell == k, origin + cells[k - 1, :3] if k else origin
        colors = None if part.face_colors is None else part.face_colors[which]
        found.append(replace(part, faces=faces[which], face_colors=colors, origin=own))
    return found
