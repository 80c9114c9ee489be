"""glTF 2.0 files: the tree's structures, the .glb container, the buffers.

Files are read only from the model's own folder, nothing over a network.
Source: Khronos, glTF 2.0 Specification.
"""

from __future__ import annotations

import base64
import binascii
import urllib.parse
from pathlib import Path
from typing import Annotated, Any

import msgspec

from renderer.errors import LucidaError
from renderer.scene.limits import BINARY_MODEL_BYTES, GLTF_JSON_BYTES, TEXT_MODEL_BYTES
from renderer.scene.reading import check_bytes, read_file, size_text, size_texts

Count = Annotated[int, msgspec.Meta(ge=0, le=1 << 40)]
Index = Annotated[int, msgspec.Meta(ge=0, le=1 << 31)]

TRIANGLE_LIST, TRIANGLE_STRIP, TRIANGLE_FAN = 4, 5, 6
COMPRESSED = ("KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression")


class Asset(msgspec.Struct, rename="camel"):
    version: str = "2.0"
    min_version: str | None = None


class Buffer(msgspec.Struct, rename="camel"):
    byte_length: Count
    uri: str | None = None


class BufferView(msgspec.Struct, rename="camel"):
    buffer: Index
    byte_length: Count
    byte_offset: Count = 0
    byte_stride: Count | None = None


class Accessor(msgspec.Struct, rename="camel"):
    component_type: int
    count: Count
    type: str
    buffer_view: Index | None = None
    byte_offset: Count = 0
    normalized: bool = False
    sparse: Any = None


class Primitive(msgspec.Struct, rename="camel"):
    attributes: dict[str, Index]
    indices: Index | None = None
    material: Index | None = None
    mode: int = TRIANGLE_LIST
    targets: Any = None


class GltfMesh(msgspec.Struct, rename="camel"):
    primitives: list[Primitive]
    name: str = ""


class Pbr(msgspec.Struct, rename="camel", frozen=True):
    base_color_factor: tuple[float, float, float, float] = (1.0, 1.0, 1.0, 1.0)
    metallic_factor: float = 1.0
    roughness_factor: float = 1.0
    base_color_texture: Any = None  # checked by gltf_textures.py
    metallic_roughness_texture: Any = None


class GltfMaterial(msgspec.Struct, rename="camel"):
    """Fields of type Any are not read: their presence is reported."""

    pbr_metallic_roughness: Pbr = Pbr()
    double_sided: bool = False
    alpha_mode: str = "OPAQUE"
    alpha_cutoff: float = 0.5
    normal_texture: Any = None
    occlusion_texture: Any = None
    emissive_factor: Any = None
    extensions: Any = None


class Node(msgspec.Struct, rename="camel"):
    name: str = ""
    mesh: Index | None = None
    children: list[Index] = []
    matrix: list[float] | None = None
    translation: tuple[float, float, float] = (0.0, 0.0, 0.0)
    rotation: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0)
    scale: tuple[float, float, float] = (1.0, 1.0, 1.0)
    skin: Any = None
    camera: Any = None  # checked by gltf_cameras.py: no model is refused for its cameras


class GltfScene(msgspec.Struct, rename="camel"):
    nodes: list[Index] = []


class GltfVersion(msgspec.Struct):
    """Fields of every version. glTF 1.0 has tables for 2.0's lists, and may omit its version."""

    asset: Asset


class Gltf(msgspec.Struct, rename="camel"):
    """The parts of a glTF tree that become objects; all others are ignored."""

    asset: Asset
    extensions_required: list[str] = []
    scene: Index = 0
    scenes: list[GltfScene] = []
    nodes: list[Node] = []
    meshes: list[GltfMesh] = []
    materials: list[GltfMaterial] = []
    accessors: list[Accessor] = []
    buffer_views: list[BufferView] = []
    buffers: list[Buffer] = []
    cameras: Any = None
    textures: Any = None
    images: Any = None
    samplers: Any = None
    animations: Any = None


def parse_gltf(data: bytes, source: str) -> tuple[Gltf, bytes | None]:
    """Return the tree of a file's bytes, and the binary chunk of a .glb file. source: its name."""
    binary = None
    text: bytes | memoryview = data
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
        raise invalid(error) from None
    except (msgspec.DecodeError, RecursionError, UnicodeDecodeError) as error:
        raise damaged(f"is not glTF: {str(error)[:120]}") from None
    least = tree.asset.min_version
    if least is not None and least != "2.0":
        problem = f"says that it needs glTF {least[:20]}"
        raise LucidaError("asset.minVersion", problem, "export it as glTF 2.0")
    for name in tree.extensions_required:
        if name in COMPRESSED:
            remedy = "open it in Blender, say, and export it without compression"
            raise LucidaError("", f"is compressed with {name}", remedy)
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

    def declared(self, number: int | None, field: str) -> BufferView:
        """Return a buffer view as it is declared. field: what names it. Raises LucidaError."""
        if number is None:
            raise LucidaError(field, "has no bufferView", "export it uncompressed")
        view: BufferView = entry_at(self.tree.buffer_views, number, f"{field}.bufferView")
        entry_at(self.tree.buffers, view.buffer, f"bufferViews[{number}].buffer")
        return view

    def view(self, number: int | None, field: str) -> memoryview:
        """Return the bytes of a buffer view. Raises LucidaError."""
        view = self.declared(number, field)
        if view.buffer not in self._read:
            self._read[view.buffer] = self._buffer(view.buffer)
        data = self._read[view.buffer]
        end = view.byte_offset + view.byte_length
        if end > len(data):
            problem = f"ends behind its buffer of {len(data)} bytes"
            raise LucidaError(f"bufferViews[{number}]", problem, "export it again")
        return memoryview(data)[view.byte_offset : end]

    def _buffer(self, number: int) -> bytes:
        buffer, field = self.tree.buffers[number], f"buffers[{number}]"
        if buffer.uri is not None:
            data = self._resource(buffer.uri, f"{field}.uri")
        elif number or self._binary is None:
            raise LucidaError(field, "has no uri and no binary chunk", "export it again")
        else:
            data = self._binary
        if len(data) < buffer.byte_length:
            declared, there = size_texts(buffer.byte_length, len(data))
            problem = f"declares {declared} and has {there}"
            raise LucidaError(field, problem, "it is cut off; export it again")
        return data

    def _resource(self, uri: str, field: str) -> bytes:
        """Return the bytes of a data URI, or of a file in the model's folder or below it."""
        if uri.startswith("data:"):
            return from_base64(uri.partition(",")[2], field)
        name, parsed = urllib.parse.unquote(uri), urllib.parse.urlsplit(uri)
        folder = self.path.parent.resolve()
        try:
            is_inside = (folder / name).resolve().is_relative_to(folder)
        except (OSError, ValueError):
            is_inside = False
        if parsed.scheme or parsed.netloc or not is_inside:
            problem = f"{uri[:80]!r} is not in the model's folder"
            raise LucidaError(field, problem, "put the file beside the model")
        try:
            return read_file(self.path.parent / name, BINARY_MODEL_BYTES)
        except LucidaError as error:
            raise LucidaError(field, f"{uri[:80]!r} {error.problem}", error.remedy) from None


def from_base64(text: str, field: str) -> bytes:
    try:
        return base64.b64decode(text, validate=True)
    except (binascii.Error, ValueError):
        raise LucidaError(field, "is not base64", "export it again") from None


def entry_at(entries: list[Any], number: int, field: str) -> Any:
    """Return an entry of a list of the tree. field: what names it. Raises LucidaError."""
    if number >= len(entries):
        raise LucidaError(
            field, f"names entry {number}, counted from 0, of {len(entries)}", "export it again"
        )
    return entries[number]


def invalid(error: msgspec.ValidationError) -> LucidaError:
    """Return the error for a value of a wrong type."""
    reason, _, where = str(error).partition(" - at `$")
    return LucidaError(
        where.strip("`."), reason[:1].lower() + reason[1:].replace("`", ""), "export it again"
    )


def damaged(problem: str) -> LucidaError:
    """Return the error for a file that is not what its ending or its header says."""
    return LucidaError("", problem, "it is cut off or of another kind; export it again")
