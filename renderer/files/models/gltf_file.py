"""glTF 2.0 files: the tree's structures, the .glb container, the buffers, the accessors.

Files are read only from the model's own folder, and never over a network.
Source: Khronos, glTF 2.0 Specification.
"""

from __future__ import annotations

import base64
import binascii
import codecs
import json
import re
import urllib.parse
from pathlib import Path
from typing import Annotated, Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from lucida.renderer.files.reading import check_bytes, damaged, read_file
from lucida.renderer.files.tables import explained
from lucida.renderer.files.texture_images import inner_path, shown
from lucida.renderer.scene.limits import BINARY_MODEL_BYTES, GLTF_JSON_BYTES, TEXT_MODEL_BYTES
from lucida.renderer.system.errors import LucidaError, under

Count = Annotated[int, msgspec.Meta(ge=0, le=1 << 40)]
Index = Annotated[int, msgspec.Meta(ge=0, le=1 << 31)]

TRIANGLE_LIST, TRIANGLE_STRIP, TRIANGLE_FAN = 4, 5, 6
TRANSFORM, LIGHTS = "KHR_texture_transform", "KHR_lights_punctual"
READ = (TRANSFORM, LIGHTS, "KHR_mesh_quantization")
MATERIALS = re.compile(
    "KHR_materials_(?!variants)"
)  # these change no geometry; gltf_materials.py notes those not shown
AGAIN = "export it again"
COMPONENT_TYPES: dict[int, np.dtype[Any]] = {
    5120: np.dtype("i1"),
    5121: np.dtype("u1"),
    5122: np.dtype("<i2"),
    5123: np.dtype("<u2"),
    5125: np.dtype("<u4"),
    5126: np.dtype("<f4"),
}
COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


class Table(msgspec.Struct, rename="camel"):
    """A table of the tree. Undeclared fields are ignored."""

    def entry(self, kind: str, number: int) -> Any:
        """Return an entry of one of the lists. Raises LucidaError."""
        entries = getattr(self, kind)
        if number >= len(entries):
            problem = f"names entry {number}, counted from 0, of {len(entries)}"
            raise LucidaError(kind, problem, AGAIN)
        return entries[number]


class Value(msgspec.Struct, rename="camel", frozen=True):
    """A table for use as a key or a default."""


class Asset(Table):
    version: str = "2.0"


class Buffer(Table):
    uri: str | None = None


class BufferView(Table):
    buffer: Index
    byte_length: Count
    byte_offset: Count = 0
    byte_stride: Count | None = None


class Accessor(Value, frozen=True):
    component_type: int
    count: Count
    type: str
    buffer_view: Index | None = None
    byte_offset: Count = 0
    normalized: bool = False
    sparse: dict[str, Any] | None = None  # rejected


class Primitive(Table):
    attributes: dict[str, Index]
    indices: Index | None = None
    material: Index | None = None
    mode: int = TRIANGLE_LIST
    targets: Any = None


class GltfMesh(Table):
    primitives: list[Primitive]
    name: str = ""


class TextureTransform(Value, frozen=True):
    offset: tuple[float, float] = (0.0, 0.0)
    scale: tuple[float, float] = (1.0, 1.0)
    rotation: float = 0.0
    tex_coord: Index | None = None


class TextureInfoExtensions(Value, frozen=True):
    transform: TextureTransform = msgspec.field(default=TextureTransform(), name=TRANSFORM)


class TextureInfo(Table):
    index: Index
    tex_coord: Index = 0
    extensions: TextureInfoExtensions = TextureInfoExtensions()

    @property
    def attribute(self) -> str:
        """Return the attribute that holds the texture coordinates."""
        own = self.extensions.transform.tex_coord
        return f"TEXCOORD_{self.tex_coord if own is None else own}"


class GltfTexture(Table):
    source: Index | None = None
    sampler: Index | None = None


class GltfImage(Table):
    uri: str | None = None
    buffer_view: Index | None = None


class GltfSampler(Table):
    wrap_s: int = 10497
    wrap_t: int = 10497


class Pbr(Value, frozen=True):
    base_color_factor: tuple[float, float, float, float] = (1.0, 1.0, 1.0, 1.0)
    metallic_factor: float = 1.0
    roughness_factor: float = 1.0
    base_color_texture: TextureInfo | None = None
    metallic_roughness_texture: TextureInfo | None = None


class GltfMaterial(Table):
    """A material. Fields of type Any are not read, but their presence is reported."""

    pbr_metallic_roughness: Pbr = Pbr()
    double_sided: bool = False
    alpha_mode: str = "OPAQUE"
    alpha_cutoff: float = 0.5
    normal_texture: Any = None
    occlusion_texture: Any = None
    emissive_factor: tuple[float, float, float] = (0.0, 0.0, 0.0)
    extensions: dict[str, Any] = {}


class LightIndex(Table):
    light: Index


class NodeExtensions(Table):
    light: LightIndex | None = msgspec.field(default=None, name=LIGHTS)


class GltfLight(Table):
    type: str
    color: tuple[float, float, float] = (1.0, 1.0, 1.0)
    intensity: float = 1.0


class Lights(Table):
    lights: list[GltfLight] = []


class GltfExtensions(Table):
    punctual: Lights = msgspec.field(default_factory=Lights, name=LIGHTS)


class Node(Table):
    name: str = ""
    mesh: Index | None = None
    children: list[Index] = []
    matrix: Annotated[list[float], msgspec.Meta(min_length=16, max_length=16)] | None = None
    translation: tuple[float, float, float] = (0.0, 0.0, 0.0)
    rotation: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0)
    scale: tuple[float, float, float] = (1.0, 1.0, 1.0)
    skin: Any = None
    camera: Index | None = None
    extensions: NodeExtensions = msgspec.field(default_factory=NodeExtensions)


class GltfScene(Table):
    nodes: list[Index] = []


class Gltf(Table):
    """The parts of a glTF tree that become objects and cameras; all others are ignored."""

    asset: Asset
    extensions_required: list[str] = []
    extensions_used: list[str] = []
    extensions: GltfExtensions = msgspec.field(default_factory=GltfExtensions)
    scene: Index = 0
    scenes: list[GltfScene] = []
    nodes: list[Node] = []
    meshes: list[GltfMesh] = []
    materials: list[GltfMaterial] = []
    accessors: list[Accessor] = []
    buffer_views: list[BufferView] = []
    buffers: list[Buffer] = []
    cameras: list[Any] = []  # checked by gltf_cameras.py, which never rejects a model
    textures: list[GltfTexture] = []
    images: list[GltfImage] = []
    samplers: list[GltfSampler] = []
    animations: Any = None


def parse_gltf(data: bytes, source: str) -> tuple[Gltf, bytes | None]:
    """Return the tree of a file's bytes, and the binary chunk of a .glb file. source: its name."""
    binary = None
    text: bytes | memoryview = data.removeprefix(codecs.BOM_UTF8)
    if data[:4] == b"glTF":
        text, binary = _chunks(data)
        check_bytes(len(text), GLTF_JSON_BYTES, source)
    else:  # the buffers may be inside, as base64
        check_bytes(len(data), TEXT_MODEL_BYTES, source)
    try:
        tree = msgspec.json.decode(text, type=Gltf)
    except msgspec.ValidationError as error:
        raise explained(str(error)) from None
    except (msgspec.DecodeError, RecursionError, UnicodeDecodeError):
        raise damaged("is not glTF: its JSON cannot be read") from None
    if not tree.asset.version.startswith("2."):
        raise LucidaError("asset.version", f"is {tree.asset.version[:20]}", "export glTF 2.0")
    for name in tree.extensions_required:
        if name not in READ and not MATERIALS.match(name):
            remedy = "open it in Blender, say, and export it without"
            raise LucidaError("extensionsRequired", f"{name[:60]} is not read", remedy)
    return tree, binary


def _chunks(data: bytes) -> tuple[memoryview, bytes]:
    """Return the JSON chunk and the binary chunk (b"" if there is none) of a .glb file."""
    version, length = (int.from_bytes(data[at : at + 4], "little") for at in (4, 8))
    chunks: dict[bytes, memoryview] = {}
    at = 12
    while at + 8 <= length <= len(data):
        size = int.from_bytes(data[at : at + 4], "little")
        chunks.setdefault(data[at + 4 : at + 8], memoryview(data)[at + 8 : at + 8 + size])
        at += 8 + size
    if version != 2 or b"JSON" not in chunks:
        problem = f"is not a complete glTF 2.0: version {version}, {length} bytes"
        raise damaged(f"{problem} of which {len(data)} exist")
    return chunks[b"JSON"], bytes(chunks.get(b"BIN\0", b""))


def glb_bytes(tree: dict[str, Any], binary: bytes = b"") -> bytes:
    """Return a .glb file of a tree and its binary chunk, padded to whole words."""
    text = json.dumps(tree, ensure_ascii=False, separators=(",", ":")).encode()
    chunks = [(b"JSON", text + b" " * (-len(text) % 4)), *[(b"BIN\0", binary)] * bool(binary)]
    content = b"".join(len(data).to_bytes(4, "little") + kind + data for kind, data in chunks)
    return b"glTF" + (2).to_bytes(4, "little") + (12 + len(content)).to_bytes(4, "little") + content


class OpenGltf:
    """A glTF file's tree and its buffers, each read once."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.tree, self._binary = parse_gltf(read_file(path, BINARY_MODEL_BYTES), str(path))
        self._read: dict[int, bytes | None] = {}

    def view(self, number: int | None) -> tuple[memoryview, int | None]:
        """Return the bytes of a buffer view, and its stride. Raises LucidaError."""
        views = self.tree.buffer_views
        if number is None or number >= len(views):
            raise LucidaError("bufferView", "is missing", "export it uncompressed")
        view = views[number]
        if view.buffer not in self._read:
            uri = self.tree.entry("buffers", view.buffer).uri
            found = self._binary if uri is None else self.resource(uri, BINARY_MODEL_BYTES)[0]
            self._read[view.buffer] = found
        data = self._read[view.buffer] or b""
        end = view.byte_offset + view.byte_length
        if end > len(data):
            problem = f"ends after its buffer of {len(data)} bytes"
            raise LucidaError(f"bufferViews[{number}]", problem, AGAIN)
        return memoryview(data)[view.byte_offset : end], view.byte_stride

    def resource(self, uri: str, most_bytes: int) -> tuple[bytes, Path | None]:
        """Return the bytes of a data URI, or of a file in the model's folder or below it, and that
        file. Raises LucidaError.
        """
        if uri.startswith("data:"):
            try:
                return base64.b64decode(uri.partition(",")[2], validate=True), None
            except (binascii.Error, ValueError):
                raise LucidaError("uri", "is not base64", AGAIN) from None
        name = urllib.parse.unquote(uri)
        with under("uri"):
            path = inner_path(name, self.path.parent)
        try:
            return read_file(path, most_bytes), path.absolute()
        except LucidaError as error:
            raise LucidaError("uri", f"{shown(name)} {error.problem}", error.remedy) from None

    def numbers(self, number: int, *types: str) -> NDArray[Any]:
        """Return the numbers of an accessor, (count, components), of the file's own type.

        types: the allowed ones. Raises LucidaError.
        """
        accessor: Accessor = self.tree.entry("accessors", number)
        field = f"accessors[{number}]"
        kind = COMPONENT_TYPES.get(accessor.component_type)
        if accessor.type not in types or kind is None or accessor.sparse is not None:
            sparse = ", sparse" * (accessor.sparse is not None)
            problem = f"is {accessor.type[:20]} of type {accessor.component_type}{sparse}"
            raise LucidaError(field, problem, "export it without")
        data, stride = self.view(accessor.buffer_view)
        shape = accessor.count, COMPONENTS[accessor.type]
        strides = stride or shape[1] * kind.itemsize, kind.itemsize
        try:
            return np.ndarray(shape, kind, data, accessor.byte_offset, strides)
        except (TypeError, ValueError):  # NumPy compares them with the buffer
            problem = f"declares {accessor.count} elements in a view of {len(data)} bytes"
            raise LucidaError(field, problem, "it is damaged; export it again") from None

    def fractions(self, number: int, *types: str) -> NDArray[Any]:
        """Return the numbers of an accessor, with normalized ones as fractions."""
        found = self.numbers(number, *types)
        if found.dtype.kind not in "ui" or not self.tree.accessors[number].normalized:
            return found
        return np.maximum(found / np.iinfo(found.dtype).max, -1).astype(np.float32)
