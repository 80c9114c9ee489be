"""Files of key cameras, KEYS.toml:

seconds = 2.0                    # from a key to the next one, unless the key says otherwise
timing = "eased"                 # or "constant" (speed), or "cut"

[[keys]]
camera = "corner.toml"           # a view file, or a table with a camera's fields
[[keys]]
camera = { eye = [0, 2, 5], target = [0, 0, 0] }
seconds = 4.0
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from lucida.renderer.files.reading import decode_text, naming, read_file
from lucida.renderer.files.schema import StrictTable
from lucida.renderer.files.tables import VERSION, parse_toml, to_struct
from lucida.renderer.files.toml_writing import value_text
from lucida.renderer.files.views import load_view, view_from_table, view_table
from lucida.renderer.scene.limits import TOML_BYTES
from lucida.renderer.system.errors import LucidaError, under

from .paths import Key, Timing

LONGEST_S = 3600.0


class KeyTable(StrictTable):
    """A table of [[keys]]."""

    camera: dict[str, Any] | str
    seconds: float | None = None
    timing: Timing | None = None


class KeyFile(StrictTable, kw_only=True):
    """A file of key cameras."""

    seconds: float = 2.0
    timing: Timing = "eased"
    keys: list[Any]


def load_keys(path: str | Path) -> list[Key]:
    """Return the keys in a file. Raises LucidaError naming the file, the field and the remedy."""
    source = str(path)
    text = decode_text(read_file(Path(path), TOML_BYTES), source)
    with naming(source):
        file: KeyFile = to_struct(parse_toml(text), KeyFile)
        if not file.keys:
            raise LucidaError("keys", "is empty", "give two cameras or more")
        return [
            _key(file, entry, f"keys[{number}]", Path(path).parent)
            for number, entry in enumerate(file.keys)
        ]


def _key(file: KeyFile, entry: Any, field: str, folder: Path) -> Key:
    table: KeyTable = to_struct(entry, KeyTable, field)
    with under(field):
        seconds = file.seconds if table.seconds is None else table.seconds
        if not 0 < seconds <= LONGEST_S:
            problem = f"{seconds:g} is not between 0 and {LONGEST_S:g}"
            raise LucidaError("seconds", problem, "give e.g. 2.0")
        if isinstance(table.camera, str):
            try:
                view = load_view(folder / table.camera)
            except LucidaError as error:
                raise error.of_file_in("camera") from None
        else:
            view = view_from_table(table.camera)
    return Key(view, seconds, table.timing or file.timing)


def keys_text(keys: Sequence[Key]) -> str:
    """Return the text of a file with these keys."""
    lines = [f"lucida = {VERSION}"]
    for key in keys:
        lines += ["", "[[keys]]", f"seconds = {key.seconds!r}", f'timing = "{key.timing}"']
        lines.append(f"camera = {value_text(view_table(key.view))}")
    return "\n".join(lines) + "\n"
