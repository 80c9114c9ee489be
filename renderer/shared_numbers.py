"""The numbers that the rasterizer's shaders, the tracer's kernels and the teaching code share.

Each stands here and nowhere else: Python imports it, numba compiles it into the kernels, and a
shader that names it gets it declared as a constant (renderer/raster/sources.py). The formulas are
written for each renderer anew: that they agree means something only where no code is shared.
"""

from __future__ import annotations

# Normals. The mean of a triangle's three vertex normals is used where it is at least this long.
SHORTEST_MEAN = 1e-6
# It is turned where the vertex normals' sum points to the other side of the triangle than its
# winding says, by more than this: a sum in the triangle's plane, up to rounding, is not.
OTHER_SIDE = -1e-5
# The cosine that shading normals keep, at least, towards the viewer.
GRAZING = 1e-3

# How far below the surface a checker is looked up, in cells, so that a face that lies in a cell's
# border stays inside one cell.
CELL_NUDGE = 1e-3

# A material's pattern, where it is not plain, nor a texture (renderer/scene/flat.py).
CHECKERED = 1
# How a texture goes on beyond its image, where it does not repeat; bits of each direction's number,
# along u in the lowest ones, then along v (renderer/scene/texture.py).
MIRROR, CLAMP = 1, 2
WRAP_BITS = 2
# A texel is one number: red, green and blue, so many bits each (renderer/scene/texture.py).
TEXEL_BITS = 10

# Light. A point light nearer than this gives none: there is no direction to it.
NEAREST_LIGHT = 1e-12
# With a half vector shorter than this there is no highlight: the light is exactly behind.
SHORTEST_HALF = 1e-6

# Rays that leave a surface, for shadows and mirrors, start a little off it, or rounding puts it in
# their way: a part of the scene's size.
AWAY = 2e-5

# sRGB's curve. Up to SRGB_LINEAR of light (SRGB_LINEAR_SHOWN of the display value) it is a line of
# slope SRGB_SLOPE, above that SRGB_SCALE * light^(1 / SRGB_GAMMA) - SRGB_SHIFT.
# Source: IEC 61966-2-1.
SRGB_LINEAR, SRGB_LINEAR_SHOWN = 0.0031308, 0.04045
SRGB_SLOPE, SRGB_SCALE, SRGB_SHIFT, SRGB_GAMMA = 12.92, 1.055, 0.055, 2.4

LUMINANCE = (0.2126, 0.7152, 0.0722)  # Rec. 709, of linear red, green, blue

# False colours. The farthest hit's gray stays apart from the misses' black.
FARTHEST_GRAY = 0.2
# A ray parameter beyond this is infinite: nothing is hit.
FARTHEST = 3e38
# Object i has colour i modulo 14, as bytes. All of them are lighter than middle gray, so that a
# bitmap of the ids is the mask of what was hit. Source: Paul Tol, Colour Schemes (2021), "light",
# "pale".
ID_PALETTE = (
    (119, 170, 221),
    (238, 136, 102),
    (68, 187, 153),
    (238, 221, 136),
    (255, 170, 187),
    (153, 221, 255),
    (170, 170, 0),
    (221, 221, 221),
    (187, 204, 51),
    (187, 204, 238),
    (255, 204, 204),
    (204, 221, 170),
    (204, 238, 255),
    (238, 238, 187),
)
MUTED = 0.35  # of its luminance: an image under what is shown of it

# Tables on the GPU. A long array is wrapped after 2^TABLE_SHIFT texels (renderer/raster/tables.py).
TABLE_SHIFT = 13
# Texels of a sphere and of an object (renderer/raster/setup.py).
SPHERE_TEXELS = 3
OBJECT_TEXELS = 15
# Of an object: its anchor in its own space, and how near it is to the eye | the anchor in image
# coordinates | from the scene's near point |
ROW_INSIDE, ROW_ANCHOR, ROW_FROM_NEAR = 0, 1, 2
# three rows: vectors of its space to image coordinates | three: to the world's directions |
ROW_IMAGE, ROW_WORLD = 3, 6
# the material: diffuse rgb, shininess | specular rgb, its pattern | of a checker the other cells'
# diffuse rgb, cells in a unit of its space; of a texture, what takes (u, v) to texels |
ROW_DIFFUSE, ROW_SPECULAR, ROW_CHECKER = 9, 10, 11
# three rows: the checker's cells, from the anchor's.
ROW_CELLS = 12
