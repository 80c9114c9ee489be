"""The limits of the scene's readers: bounds on files, counts and depths.

Every number a file claims is checked against one of these, or against the file's own size, before
memory is set aside for it.
"""

from __future__ import annotations

TOML_BYTES = 4 << 20  # of a scene file or a view file
KEY_PARTS = 32  # of a dotted key in TOML: the parser's time grows with their square
BINARY_MODEL_BYTES = 1 << 30  # of a .ply, .stl, .glb or .bin file
TEXT_MODEL_BYTES = 256 << 20  # of a model written as text, which needs some 20 times that to read
GLTF_JSON_BYTES = 32 << 20  # of the JSON part of a .gltf or .glb file
MATERIAL_BYTES = 4 << 20  # of the .mtl file of an .obj file

TEXTURE_SIDE = 8192  # texels
IMAGE_BYTES = 4 * TEXTURE_SIDE**2 + (1 << 20)  # of the file of a texture, not compressed
TEXELS = (1 << 26) + (1 << 20)  # of a scene's textures together
TEXTURES = 256  # of a model or a scene file
JPEG_SCANS = 200  # of a progressive JPEG, each of which takes as long as the whole image

OBJECTS = 10_000  # of a scene, after the parts of its models are counted apart
LIGHTS = 64
VIEWS = 1000  # of a scene, from its models
TRIANGLES = 20_000_000  # of a scene, instances counted as often as they appear
SEGMENTS = 1024  # of a round shape, in one direction
