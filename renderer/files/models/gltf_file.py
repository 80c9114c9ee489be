"""glTF 2.0 files: the tree's structures, the .glb container, the buffers.

Files are read only from the model's own folder, nothing over a network.
Source: Khronos, glTF 2.0 Specification.
"""

from __future__ import annotations

import base64
import binascii
import codecs
import re
import urllib.parse
from pathlib import Path
from typing import Annotated, Any

import msgspec

from lucida.renderer.files.reading import check_bytes, damaged, read_file, size_text
from lucida.renderer.files.tables import explained
from lucida.renderer.files.texture_images import inner_path, shown
from lucida.renderer.scene.limits import BINARY_MODEL_BYTES, GLTF_JSON_BYTES, TEXT_MODEL_BYTES
from lucida.renderer.system.errors import LucidaError, under

Count = Annotated[int, msgspec.Meta(ge=0, le=1 << 40)]
Index = Annotated[int, msgspec.Meta(ge=0, le=1 << 31)]

TRIANGLE_LIST, TRIANGLE_STRIP, TRIANGLE_FAN = 4, 5, 6
TRANSFORM, WEBP = "KHR_texture_transform", "EXT_texture_webp"
LIGHTS = "KHR_lights_punctual"
READ = (TRANSFORM, WEBP, LIGHTS, "KHR_mesh_quantization")
MATERIALS = re.compile(
    "KHR_materials_(?!variants)"
)  # these change no geometry: gltf_materials.py names what is not shown


class Table(msgspec.Struct, rename="camel"):
    """A table of the tree. Fields that it does not name are ignored."""


class Value(msgspec.Struct, rename="camel", frozen=True):
    """A table that is a key, or a default."""


class Asset(Table):
    version: str = "2.0"


class Buffer(Table):
    byte_length: Count
    uri: str | None = None


class BufferView(Table):
    buffer: Index
    byte_length: Count
    byte_offset: Count = 0
    byte_stride: Count | None = None


class Sparse(Value, frozen=True):
    """Sparse numbers, which are refused."""


class Accessor(Value, frozen=True):
    component_type: int
    count: Count
    type: str
    buffer_view: Index | None = None
    byte_offset: Count = 0
    normalized: bool = False
    sparse: Sparse | None = None


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


class Webp(Table):
    source: Index


class TextureExtensions(Value, frozen=True):
    webp: Webp | None = msgspec.field(default=None, name=WEBP)


class GltfTexture(Table):
    source: Index | None = None
    sampler: Index | None = None
    extensions: TextureExtensions = TextureExtensions()


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
    """Fields of type Any are not read: their presence is reported."""

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


class GltfVersion(Table):
    """Fields of every version. glTF 1.0 has tables for 2.0's lists, and may omit its version."""

    asset: Asset


class Gltf(GltfVersion):
    """The parts of a glTF tree that become objects and cameras; all others are ignored."""

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
    cameras: list[Any] = []  # checked by gltf_cameras.py: no model is refused for its cameras
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
        if len(text) > GLTF_JSON_BYTES:
            raise LucidaError("", f"has {size_text(len(text))} of JSON", "split the model")
    else:  # its buffers may be inside, as base64
        check_bytes(len(data), TEXT_MODEL_BYTES, source)
    try:
        version = msgspec.json.decode(text, type=GltfVersion).asset.version
        if version.split(".")[0] != "2":
            raise _of_version(version)
        tree = msgspec.json.decode(text, type=Gltf)
    except msgspec.ValidationError as error:
        raise explained(str(error)) from None
    except (msgspec.DecodeError, RecursionError, UnicodeDecodeError):
        raise damaged("is not glTF: its JSON cannot be read") from None
    for name in tree.extensions_required:
        if name not in READ and not MATERIALS.match(name):
            remedy = "open it in Blender, say, and export it without"
            raise LucidaError("extensionsRequired", f"{name[:60]} is not read", remedy)
    return tree, binary


def _of_version(version: str) -> LucidaError:
    return LucidaError("", f"is glTF {version[:20]}", "export it as glTF 2.0")


def _chunks(data: bytes) -> tuple[memoryview, bytes]:
    """Return the JSON chunk and the binary chunk (b"" if there is none) of a .glb file."""
    version, length = (int.from_bytes(data[at : at + 4], "little") for at in (4, 8))
    if len(data) >= 12 and version != 2:
        raise _of_version(f"{version}.0")
    if len(data) < 20 or length > len(data):
        raise damaged(f"declares {length} bytes and has {len(data)}")
    chunks: dict[bytes, memoryview] = {}
    at = 12
    while at + 8 <= length:
        size = int.from_bytes(data[at : at + 4], "little")
        if at + 8 + size > length:
            raise damaged(f"declares a chunk of {size} bytes, {length - at - 8} are left")
        chunks.setdefault(data[at + 4 : at + 8], memoryview(data)[at + 8 : at + 8 + size])
        at += 8 + size
    if b"JSON" not in chunks:
        raise damaged("has no JSON chunk")
    return chunks[b"JSON"], bytes(chunks.get(b"BIN\0", b""))


class OpenGltf:
    """A glTF file's tree and its buffers, each read once."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.tree, self._binary = parse_gltf(read_file(path, BINARY_MODEL_BYTES), str(path))
        self._read: dict[int, bytes] = {}

    def view(self, number: int | None, field: str) -> tuple[memoryview, int | None]:
        """Return the bytes of a buffer view, and its stride. field: what names it. Raises
        LucidaError.
        """
        if number is None:
            raise LucidaError(field, "has no bufferView", "export it uncompressed")
        view: BufferView = entry_at(self.tree.buffer_views, number, f"{field}.bufferView")
        if view.buffer not in self._read:
            self._read[view.buffer] = self._buffer(view.buffer, f"bufferViews[{number}].buffer")
        data = self._read[view.buffer]
        end = view.byte_offset + view.byte_length
        if end > len(data):
            problem = f"ends behind its buffer of {len(data)} bytes"
            raise LucidaError(f"bufferViews[{number}]", problem, "export it again")
        return memoryview(data)[view.byte_offset : end], view.byte_stride

    def _buffer(self, number: int, named_by: str) -> bytes:
        buffer, field = entry_at(self.tree.buffers, number, named_by), f"buffers[{number}]"
        if buffer.uri is not None:
            data, _ = self.resource(buffer.uri, f"{field}.uri", BINARY_MODEL_BYTES)
        elif number or self._binary is None:
            raise LucidaError(field, "has no uri and no binary chunk", "export it again")
        else:
            data = self._binary
        if len(data) < buffer.byte_length:
            problem = f"declares {buffer.byte_length:,} bytes and has {len(data):,}"
            raise LucidaError(field, problem, "it is cut off; export it again")
        return data

    def resource(self, uri: str, field: str, most_bytes: int) -> tuple[bytes, Path | None]:
        """Return the bytes of a data URI, or of a file in the model's folder or below it, and that
        file. Raises LucidaError.
        """
        if uri.startswith("data:"):
            try:
                return base64.b64decode(uri.partition(",")[2], validate=True), None
            except (binascii.Error, ValueError):
                raise LucidaError(field, "is not base64", "export it again") from None
        name = urllib.parse.unquote(uri)
        with under(field):
            path = inner_path(name, self.path.parent)
        try:
            return read_file(path, most_bytes), path.absolute()
        except LucidaError as error:
            raise LucidaError(field, f"{shown(name)} {error.problem}", error.remedy) from None


def entry_at(entries: list[Any], number: int, field: str) -> Any:
    """Return an entry of a list of the tree. field: what names it. Raises LucidaError."""
    if number >= len(entries):
        raise LucidaError(
            field, f"names entry {number}, counted from 0, of {len(entries)}", "export it again"
        )
    return entries[number]
