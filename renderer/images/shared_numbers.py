"""Constants shared by the rasterizer's shaders, the tracer's kernels and the teaching code.

Each is defined only here. Python imports it, numba compiles it into the kernels, and it is declared
as a constant in shaders that name it (renderer/raster/sources.py). Each renderer has its own
formulas, because their agreement is meaningful only if they share no code.
"""

from __future__ import annotations

# Normals. The mean of a triangle's three vertex normals is used if it is at least this long.
SHORTEST_MEAN = 1e-6
# It is negated if the vertex normals' sum is opposite to the winding's normal by more than this, so
# that a sum in the triangle's plane, up to rounding, is not negated.
OTHER_SIDE = -1e-5
# The least cosine between shading normals and the direction to the viewer.
GRAZING = 1e-3

# The depth below the surface, in cells, at which a checker is evaluated, so that a face on a
# border between cells stays inside one cell.
CELL_NUDGE = 1e-3

# A material's pattern, if it is neither plain nor a texture (renderer/scene/flat.py).
CHECKERED = 1
# A texture's wrap mode beyond its image, if it does not repeat: bits for each direction, u in the
# lowest ones, then v (renderer/scene/texture.py).
MIRROR, CLAMP = 1, 2
WRAP_BITS = 2
# A texel is one number: red, green and blue, with this many bits each (renderer/scene/texture.py).
TEXEL_BITS = 10

# Light. A point light nearer than this has no direction, and therefore no light.
NEAREST_LIGHT = 1e-12
# A half vector shorter than this has no highlight, because the light is exactly behind.
SHORTEST_HALF = 1e-6

# The offset of shadow and mirror rays from their surface, relative to the scene's size. Without it,
# rounding makes them hit the surface itself.
AWAY = 2e-5

# sRGB's curve. Up to SRGB_LINEAR of light (SRGB_LINEAR_SHOWN of the display value) it is a line of
# slope SRGB_SLOPE, above that SRGB_SCALE * light^(1 / SRGB_GAMMA) - SRGB_SHIFT.
# Source: IEC 61966-2-1.
SRGB_LINEAR, SRGB_LINEAR_SHOWN = 0.0031308, 0.04045
SRGB_SLOPE, SRGB_SCALE, SRGB_SHIFT, SRGB_GAMMA = 12.92, 1.055, 0.055, 2.4

LUMINANCE = (0.2126, 0.7152, 0.0722)  # Rec. 709, of linear red, green, blue

# False colours. The farthest hit's gray, distinct from the misses' black.
FARTHEST_GRAY = 0.2
# A larger ray parameter counts as infinite: nothing is hit.
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
MUTED = 0.35  # a factor for the luminance of an image under an overlay

# Tables on the GPU. A long array is wrapped after 2^TABLE_SHIFT texels (renderer/raster/tables.py).
TABLE_SHIFT = 13
# Texels per sphere and per object (renderer/raster/setup.py).
SPHERE_TEXELS = 3
OBJECT_TEXELS = 15
# An object's texels: its anchor in its own space, and how near it is to the eye | the anchor in
# image coordinates | the anchor from the scene's near point |
ROW_INSIDE, ROW_ANCHOR, ROW_FROM_NEAR = 0, 1, 2
# three rows: from vectors in its space to image coordinates | three: to world directions |
ROW_IMAGE, ROW_WORLD = 3, 6
# the material: diffuse rgb, shininess | specular rgb, its pattern | for a checker, the other cells'
# diffuse rgb, and cells per unit of its space; for a texture, the map from (u, v) to texels |
ROW_DIFFUSE, ROW_SPECULAR, ROW_CHECKER = 9, 10, 11
# three rows: the checker's cells, relative to the anchor's.
ROW_CELLS = 12
