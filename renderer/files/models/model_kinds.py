"""Recognise other programs' model files by their first bytes."""

from __future__ import annotations

from pathlib import Path

from lucida.renderer.files.reading import first_bytes
from lucida.renderer.system.errors import LucidaError

_KINDS = {
    b"Kaydara FBX": "FBX", b"; FBX": "FBX", b"#usda": "USD", b"PXR-USDC": "USD",
    b"PK\3\4": "a ZIP archive (as USDZ and 3MF are)", b"\x1f\x8b": "compressed (gzip)",
    b"BLENDER": "Blender's", b"\x28\xb5\x2f\xfd": "compressed (as Blender's are)",
    b"ISO-10303-21": "STEP or IFC", b"#VRML": "VRML",
}  # fmt: skip


def check_kind(path: Path) -> None:
    """Raise LucidaError if a file begins as one of a kind that is not read. One that cannot be read
    is reported elsewhere.
    """
    try:
        head, size = first_bytes(path, 1000), path.stat().st_size
    except (OSError, ValueError):
        return
    found = next((kind for begin, kind in _KINDS.items() if head.startswith(begin)), "")
    if b"<COLLADA" in head or b"<X3D" in head:
        found = "COLLADA or X3D"
    elif head.startswith(b"MM") and int.from_bytes(head[2:6], "little") == size:
        found = "3DS"
    if found:
        problem = f"is {found}, which is not read"
        raise LucidaError("", problem, "export it as .glb", str(path))
