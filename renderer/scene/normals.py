"""Smooth vertex normals, except across creases, for meshes without normals."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Ints = NDArray[np.int64]
Floats32 = NDArray[np.float32]

CREASE_DEG = 40.0  # an edge with a larger angle between its faces stays sharp


def merge_positions(vertices: Floats32) -> Ints:
    """Return the first vertex at exactly the same position for each vertex (n, 3): int64 (n,)."""
    bits = (vertices + np.float32(0)).view(np.uint32).astype(np.uint64)  # + 0 makes -0 into 0
    xy = bits[:, 0] << np.uint64(32) | bits[:, 1]
    order = np.lexsort((bits[:, 2], xy))  # stable, so that the first of equals stays first
    xy, z = xy[order], bits[order, 2]
    starts = np.concatenate([[True], (xy[1:] != xy[:-1]) | (z[1:] != z[:-1])])
    first = order[starts][np.cumsum(starts) - 1]
    merged = np.empty(len(vertices), np.int64)
    merged[order] = first
    return merged


def face_normals(vertices: Floats32, faces: Ints) -> NDArray[np.float64]:
    """Return cross(b - a, c - a) of each face (m, 3): its normal, with twice its area as length."""
    a, b, c = (vertices[faces[:, corner]].astype(np.float64) for corner in range(3))
    return np.cross(b - a, c - a)


def smooth_normals(
    vertices: Floats32,
    faces: Ints,
    merged: Ints | None = None,
    keep_apart: bool = False,
) -> tuple[Ints, Ints, Floats32]:
    """Return normals that are smooth except across creases.

    vertices (n, 3); faces (m, 3), none of area 0, with consistent winding if they should join.
    Vertices in one position share their normals. Returns (source, faces, normals): the new vertex k
    is a copy of vertex source[k], with the unit normal normals[k]; a vertex on a crease has several
    copies. Vertices in one position become one, unless keep_apart, because they may differ in
    colour.
    merged: the result of merge_positions(), if known.
    Corners are weighted by their angle, after Thürmer and Wüthrich 1998,
    "Computing vertex normals from polygonal facets".
    """
    joined = (merge_positions(vertices) if merged is None else merged)[faces]
    normals = face_normals(vertices, joined)
    doubled = np.linalg.norm(normals, axis=1, keepdims=True)
    normals /= doubled
    label = components(joined.size, *_smooth_corners(joined, normals, len(vertices)))
    roots = np.flatnonzero(label == np.arange(len(label)))
    number = np.empty(len(label), np.int64)
    number[roots] = np.arange(len(roots))
    shared = number[label]
    weights = _corner_angles(vertices, joined, doubled)
    summed = np.stack(
        [
            np.bincount(shared, (weights * normals[:, [axis]]).reshape(-1), len(roots))
            for axis in range(3)
        ],
        axis=1,
    )
    lengths = np.linalg.norm(summed, axis=1, keepdims=True)
    unit = np.divide(summed, lengths, out=np.zeros_like(summed), where=lengths > 1e-6)
    unit = unit.astype(np.float32)
    corner = faces.reshape(-1)
    if not keep_apart:
        return corner[roots], shared.reshape(-1, 3), unit
    _, first, inverse = np.unique(
        shared * len(vertices) + corner, return_index=True, return_inverse=True
    )
    return corner[first], inverse.reshape(-1, 3), unit[shared[first]]


def _smooth_corners(
    faces: Ints, normals: NDArray[np.float64], vertex_count: int
) -> tuple[Ints, Ints]:
    """Return pairs of corners that share a normal: those at both ends of each edge that is not a
    crease.

    Corner k of face f has the number 3 f + k, and so has the edge that begins there.
    """
    begin, end = faces, np.roll(faces, -1, axis=1)
    key = (np.minimum(begin, end) * vertex_count + np.maximum(begin, end)).reshape(-1)
    order = np.argsort(key, kind="stable")
    same = key[order[1:]] == key[order[:-1]]
    first, second = order[:-1][same], order[1:][same]
    # Two faces of one winding run along their common edge in opposite directions.
    opposite = begin.reshape(-1)[first] == end.reshape(-1)[second]
    turn = np.einsum("ij,ij->i", normals[first // 3], normals[second // 3])
    smooth = opposite & (turn >= math.cos(math.radians(CREASE_DEG)))
    first, second = first[smooth], second[smooth]
    after_first, after_second = (edge - edge % 3 + (edge + 1) % 3 for edge in (first, second))
    return np.concatenate([first, after_first]), np.concatenate([after_second, second])


def components(count: int, a: Ints, b: Ints) -> Ints:
    """Return the smallest member of each node's connected component, in a graph with edges a[k] -
    b[k].

    The method is hooking and pointer jumping, after Shiloach and Vishkin 1982.
    """
    parent = np.arange(count)
    while len(a):
        np.minimum.at(parent, np.maximum(a, b), np.minimum(a, b))
        while not np.array_equal(parent, jumped := parent[parent]):
            parent = jumped
        a, b = parent[a], parent[b]
        apart = a != b
        a, b = a[apart], b[apart]
    return parent


def _corner_angles(
    vertices: Floats32, faces: Ints, doubled: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the angle at each corner of each face, radians: float64 (m, 3).

    doubled: twice the faces' areas (m, 1), the length of the cross product of two sides.
    """
    corners = vertices[faces].astype(np.float64)
    sides = corners[:, [1, 2, 0]] - corners
    cosine = -np.einsum("ijk,ijk->ij", sides, sides[:, [2, 0, 1]])
    return np.arctan2(doubled, cosine)
