"""glTF 2.0 files as they lie on disk: the tree's structures, the .glb container, the buffers.

Owns what is read from which file: only from the model's own folder, nothing over a network. Knows
nothing of what the tree means.
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


class GltfMesh(msgspec.Struct, rename="camel"):
    primitives: list[Primitive]
    name: str = ""


class Pbr(msgspec.Struct, rename="camel", frozen=True):
    base_color_factor: tuple[float, float, float, float] = (1.0, 1.0, 1.0, 1.0)
    metallic_factor: float = 1.0
    roughness_factor: float = 1.0
    base_color_texture: Any = None  # gltf_textures.py looks at them, and at what they name
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
    camera: Any = None  # gltf_cameras.py looks at it: no model is refused for its cameras


class GltfScene(msgspec.Struct, rename="camel"):
    nodes: list[Index] = []


class Gltf(msgspec.Struct, rename="camel"):
    """The parts of a glTF tree that become objects; all else in it is passed over."""

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


def open_gltf(path: Path) -> tuple[Gltf, bytes | None]:
    """The tree, and the binary chunk of a .glb file."""
    return parse_gltf(read_file(path, BINARY_MODEL_BYTES), str(path))


def parse_gltf(data: bytes, source: str) -> tuple[Gltf, bytes | None]:
    """The same of a file's bytes. source: its name."""
    binary = None
    text: bytes | memoryview = data
    if data[:4] == b"glTF":
        text, binary = _chunks(data)
        if len(text) > GLTF_JSON_BYTES:
            raise LucidaError("", f"has {size_text(len(text))} of JSON", "split the model")
    else:  # its buffers may be inside, as base64
        check_bytes(len(data), TEXT_MODEL_BYTES, source)
    try:
        tree = msgspec.json.decode(text, type=Gltf)
    except msgspec.ValidationError as error:
        raise _of_version_1(text) or invalid(error) from None
    except (msgspec.DecodeError, RecursionError, UnicodeDecodeError) as error:
        raise damaged(f"is not glTF: {str(error)[:120]}") from None
    if tree.asset.version.split(".")[0] != "2":
        raise _is_gltf(tree.asset.version)
    for name in tree.extensions_required:
        if name in COMPRESSED:
            remedy = "open it in Blender, say, and export it without compression"
            raise LucidaError("", f"is compressed with {name}", remedy)
    return tree, binary


def _is_gltf(version: str) -> LucidaError:
    return LucidaError("", f"is glTF {version[:20]}", "export it as glTF 2.0")


def _of_version_1(text: bytes | memoryview) -> LucidaError | None:
    """Return the error for a tree of glTF 1.0, which has objects by name in place of lists and may
    leave its version out; None for any other."""
    try:
        tree = msgspec.json.decode(text)
    except (msgspec.DecodeError, RecursionError, UnicodeDecodeError):
        return None  # it was refused before its end was seen
    asset = tree.get("asset") if isinstance(tree, dict) else None
    version = str(asset.get("version", "1.0") if isinstance(asset, dict) else "1.0")
    lists = ("scenes", "nodes", "meshes", "accessors", "bufferViews", "buffers", "materials")
    is_old = isinstance(tree, dict) and any(isinstance(tree.get(name), dict) for name in lists)
    return _is_gltf(version) if is_old and not version.startswith("2") else None


def _chunks(data: bytes) -> tuple[memoryview, bytes]:
    """The JSON chunk and the binary chunk (b"" if there is none) of a .glb file."""
    version, length = (int.from_bytes(data[at : at + 4], "little") for at in (4, 8))
    if len(data) >= 12 and version != 2:
        raise _is_gltf(f"{version}.0")
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


def read_buffer(buffer: Buffer, number: int, binary: bytes | None, path: Path) -> bytes:
    field = f"buffers[{number}]"
    if buffer.uri is None:
        if number or binary is None:
            raise LucidaError(field, "has no uri and no binary chunk", "export it again")
        data = binary
    elif buffer.uri.startswith("data:"):
        _, comma, text = buffer.uri.partition(",")
        try:
            data = base64.b64decode(text, validate=True) if comma else b""
        except (binascii.Error, ValueError):
            raise LucidaError(f"{field}.uri", "is not base64", "export it again") from None
    else:
        data = _file_beside(buffer.uri, f"{field}.uri", path)
    if len(data) < buffer.byte_length:
        declared, there = size_texts(buffer.byte_length, len(data))
        raise LucidaError(
            field, f"declares {declared} and has {there}", "it is cut off; export it again"
        )
    return data


class GltfBuffers:
    """A tree's buffers, each read once. binary: of a .glb file. path: the file."""

    def __init__(self, tree: Gltf, binary: bytes | None, path: Path) -> None:
        self._tree, self._binary, self._path = tree, binary, path
        self._read: dict[int, bytes] = {}

    def get(self, number: int) -> bytes:
        if number not in self._read:
            buffer = entry_at(self._tree.buffers, number, f"buffers[{number}]")
            self._read[number] = read_buffer(buffer, number, self._binary, self._path)
        return self._read[number]

    def declared(self, number: int | None, field: str) -> BufferView:
        """Return a buffer view as it is declared. field: what names it. Raises LucidaError."""
        if number is None:
            raise LucidaError(field, "has no bufferView", "export it uncompressed")
        view: BufferView = entry_at(self._tree.buffer_views, number, f"{field}.bufferView")
        entry_at(self._tree.buffers, view.buffer, f"bufferViews[{number}].buffer")
        return view

    def view(self, number: int | None, field: str) -> tuple[memoryview, BufferView]:
        """Return the bytes of a buffer view, and that. Raises LucidaError."""
        view = self.declared(number, field)
        data = memoryview(self.get(view.buffer))
        if view.byte_offset + view.byte_length > len(data):
            problem = f"ends behind its buffer of {len(data)} bytes"
            raise LucidaError(f"bufferViews[{number}]", problem, "export it again")
        return data[view.byte_offset : view.byte_offset + view.byte_length], view


def _file_beside(uri: str, field: str, path: Path) -> bytes:
    """A file named by a relative URI, in the model's folder or below it."""
    name = urllib.parse.unquote(uri)
    parsed = urllib.parse.urlsplit(uri)
    folder = path.parent.resolve()
    try:
        target = (folder / name).resolve()
        inside = target.is_relative_to(folder)
    except (OSError, ValueError):
        inside = False
    if parsed.scheme or parsed.netloc or not inside:
        raise LucidaError(
            field, f"{uri[:80]!r} is not in the model's folder", "put the file beside the model"
        )
    try:
        return read_file(path.parent / name, BINARY_MODEL_BYTES)
    except LucidaError as error:
        raise LucidaError(field, f"{uri[:80]!r} {error.problem}", error.remedy) from None


def entry_at(entries: list[Any], number: int, field: str) -> Any:
    """An entry of a list of the tree's. field: what names it. Raises LucidaError."""
    if number >= len(entries):
        raise LucidaError(
            field, f"names entry {number}, counted from 0, of {len(entries)}", "export it again"
        )
    return entries[number]


def invalid(error: msgspec.ValidationError) -> LucidaError:
    """The error for a value of another type than glTF says."""
    reason, _, where = str(error).partition(" - at `$")
    return LucidaError(
        where.strip("`."), reason[:1].lower() + reason[1:].replace("`", ""), "export it again"
    )


def damaged(problem: str) -> LucidaError:
    """The error for a file that is not what its ending or its header says."""
    return LucidaError("", problem, "it is cut off or of another kind; export it again")
