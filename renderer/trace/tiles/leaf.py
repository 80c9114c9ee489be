"""A leaf's 16 triangles against a tile's 256 pixels, by the cheapest of three methods.

A triangle is three edge functions and a key (triangle.py), which are affine in the image. The edge
functions are set up once, with 16 triangles in lanes; keys are set up only if some triangle may
cover a pixel. When a leaf covers few pixels, each of them is tested against all triangles
(by_pixels.py). Small triangles are tested at the pixels in their own rectangles (by_boxes.py), and
large ones at the tile's squares (by_squares.py).
"""

from __future__ import annotations

import numpy as np

from lucida.renderer.trace.bvh.instances import HAS_HOLES
from lucida.renderer.trace.compile.compiled import inlined
from lucida.renderer.trace.reference.vectors import times
from lucida.renderer.trace.vector.lanes import bits, mask_of, smallest, splat
from lucida.renderer.trace.vector.memory import load

from .by_boxes import PixelBoxes, pixel_boxes, sample_boxes
from .by_pixels import FEW_PIXELS, cover_pixels, sample_pixels
from .by_squares import cover_tile, rasterize_squares
from .footprint import pixels_of
from .tile import from_first_pixel
from .triangle import Triangles, camera_corners, edge_function, homogeneous, triangle_keys

SOME_PIXELS = 160  # in a larger footprint, most of a leaf's triangles are not small


@inlined
def rasterize_leaf(view, world, leaf, space, tile, footprint, squares, depth, least, scratch):
    """Rasterize a leaf's triangles into the tile. Return the tile's new least key.

    footprint: of the leaf's box; depth: the least Z in it. squares: bits, the squares of the
    footprint in which some pixel sees nothing nearer. least: the smallest of the pixels' best keys;
    nothing farther is visible at any pixel.
    """
    own = from_first_pixel(tile)
    a, b, c = camera_corners(view, world.corner, leaf, space, tile, scratch)
    ha, hb, hc = homogeneous(view, a, b, c)
    pa, pb, pc = (a[0], a[1], ha), (b[0], b[1], hb), (c[0], c[1], hc)
    edges = edge_function(pa, pb), edge_function(pb, pc), edge_function(pc, pa)

    # Choose the methods. Holes are looked up by squares only.
    pixels, has_holes = pixels_of(footprint), world.attributes[space] & HAS_HOLES != 0
    by_pixels = pixels <= FEW_PIXELS and not has_holes
    by_boxes = pixels <= SOME_PIXELS and not has_holes

    # Determine the triangles that may cover a pixel: small ones, and large ones if their volume is
    # positive (front), and if it is negative (back).
    zero = splat(np.float32(0))
    front = back = small = mask_of(0)
    boxes, large, count = PixelBoxes(zero, zero, zero, zero), a[0] == a[0], 0
    if by_pixels:
        front, back, count = cover_pixels(view, edges, own, footprint, squares, depth, scratch)
    else:
        if by_boxes:
            boxes, small, large = pixel_boxes(view, own, pa, pb, pc)
        if bits(large) != 0:
            front, back = cover_tile(edges, own)
            front, back = front & large, back & large
    wanted = front | back | small
    if bits(wanted) == 0:
        return least

    # Set up their keys, and give the edge functions the signs of the volumes.
    key, sign = triangle_keys(view, world.corner, leaf, space, tile, a, b, c, ha, hb, hc, wanted)
    signed = times(sign, edges[0]), times(sign, edges[1]), times(sign, edges[2])
    triangles = Triangles(signed, key, leaf, space)

    if by_pixels:
        return sample_pixels(view, world, triangles, own, count, least, scratch)
    if bits(small) != 0:
        sample_boxes(view, world, triangles, boxes, small, own, scratch)
        least = smallest(load(scratch.least, 0))
    is_front = sign > np.float32(0)
    large = (front & is_front) | (back & ~is_front)
    if bits(large) == 0:
        return least
    return rasterize_squares(view, world, triangles, large, tile, squares, least, scratch)
