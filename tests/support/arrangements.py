"""One scene file in many arrangements: inline tables, dotted keys, tables in tables, comments
wherever TOML allows them. Each comment is known by what it belongs to."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from renderer.scene.toml_writing import key_text, value_text

Random = np.random.Generator
Path = tuple[str | int, ...]

TABLES: dict[str, Any] = {
    "name": "arranged",
    "ambient": [0.1, 0.1, 0.12],
    "camera": {"eye": [0.3, 1.2, 5], "target": [0, 0, 0], "fov_y_deg": 40.0},
    "materials": {
        "red": {"diffuse": "#d04020", "specular": [0.4, 0.4, 0.4]},
        "floor": {"diffuse": [0.6, 0.6, 0.6], "checker": {"diffuse": [0.1, 0.2, 0.1], "size": 0.5}},
        "a b": {"texture": {"file": "texels.png", "wrap": ["clamp", "repeat"]}},
    },
    "lights": [
        {"type": "directional", "direction": [0.4, -1, -0.5]},
        {"type": "point", "position": [2, 3, 2], "color": [0.3, 0.3, 0.3]},
    ],
    "objects": [
        {"type": "rectangle", "material": "floor", "width": 4, "depth": 4},
        {"type": "sphere", "name": "#ball", "material": "red", "radius": 0.6},
        {"type": "box", "size": [0.5, 1.0, 0.7], "material": {"texture": "texels.png"}},
        {
            "type": "torus",
            "segments": 8,
            "material": {
                "diffuse": [0.2, 0.3, 0.8],
                "checker": {"diffuse": "#112233", "size": 0.25},
            },
        },
        {"type": "box", "material": {"texture": {"file": "texels.png", "scale": [2, 2]}}},
    ],
}


class Arrangement(NamedTuple):
    """A text that holds TABLES. owners: for each of its comments the path of what it belongs to;
    () for comments that belong to the file. pieces: the letters of statements and of elements with
    the path of what they say."""

    text: str
    owners: dict[str, Path]
    pieces: list[tuple[str, Path]]


def arranged(rng: Random) -> Arrangement:
    return _Writer(rng).written()


class _Writer:
    def __init__(self, rng: Random) -> None:
        self._rng = rng
        self._owners: dict[str, Path] = {}
        self._pieces: list[tuple[str, Path]] = []
        self._headers: dict[int, str] = {}  # the list of which a section is an element
        self._comments = float(rng.choice([0.15, 0.5]))
        self._indent = str(rng.choice(["", "", "\t", "  "]))

    def _chance(self, part: float) -> bool:
        return bool(self._rng.random() < part)

    def written(self) -> Arrangement:
        below: list[list[str]] = []
        lines: list[str] = []
        for key, value in TABLES.items():
            if isinstance(value, list) and isinstance(value[0], dict):
                if self._chance(0.25):
                    lines += self._list(key, value)
                    continue
                for number, entry in enumerate(value):
                    below.append(self._section((key, number), f"[{self._header((key,))}]", entry))
                    self._headers[id(below[-1])] = key
            elif isinstance(value, dict):
                above, parts = self._table(key, value)
                lines += above
                below += parts
            else:
                lines += self._statement((key,), self._key(key), value, ())
        if self._chance(0.5):  # the order of sections is free, but for those of one list
            keys = [float(self._rng.random()) for _ in below]
            for kind in ("objects", "lights"):
                own = [k for k, part in enumerate(below) if self._headers.get(id(part)) == kind]
                for k, key in zip(own, sorted(keys[k] for k in own), strict=True):
                    keys[k] = key
            below = [part for _, part in sorted(zip(keys, below, strict=True), key=lambda p: p[0])]
        parts = [lines, *below]
        text = "".join(line + "\n" for part in parts for line in [*part, *self._between(part)])
        if self._chance(0.2):
            text = text.rstrip("\n")
        newline = "\r\n" if self._chance(0.3) else "\n"
        pieces = [(piece.replace("\n", newline), path) for piece, path in self._pieces]
        return Arrangement(text.replace("\n", newline), self._owners, pieces)

    def _key(self, name: str) -> str:
        """A key, in quotes where it needs them, and sometimes elsewhere."""
        return str(self._rng.choice([f'"{name}"', f"'{name}'"] + 6 * [key_text(name)]))

    def _header(self, path: Path) -> str:
        space = " " * self._chance(0.1)
        keys = f"{space}.{space}".join(self._key(part) for part in path if isinstance(part, str))
        return f"[{space}{keys}{space}]"

    def _between(self, part: list[str]) -> list[str]:
        if self._chance(self._comments):
            return ["", self._comment(()), ""]
        # A comment directly above a header would be the header's.
        return [""] if self._chance(0.8) or part[-1].lstrip().startswith("#") else []

    def _comment(self, owner: Path) -> str:
        comment = f"# {len(self._owners)} \"'{{[,]}} ="
        self._owners[comment] = owner
        return comment

    def _above(self, owner: Path) -> list[str]:
        return [self._comment(owner)] if self._chance(self._comments) else []

    def _behind(self, owner: Path) -> str:
        return f"  {self._comment(owner)}" if self._chance(self._comments) else ""

    def _statement(self, path: Path, key: str, value: Any, unit: Path) -> list[str]:
        """path: the comment behind it belongs to that. unit: the one above it to that."""
        between = str(self._rng.choice(["=", " = ", "  =\t"]))
        text = self._value(path, value)
        statement = f"{key}{between}{text}{self._behind(path)}"
        self._pieces.append((statement, path))
        return [self._indent + line for line in (*self._above(unit), statement)]

    def _value(self, path: Path, value: Any) -> str:
        if isinstance(value, dict):
            space = str(self._rng.choice(["", " "]))
            inner = ", ".join(
                f"{key} = {text}"
                for keys, v in self._leaves(value)
                for key, text in [(".".join(map(self._key, keys)), self._value((*path, *keys), v))]
            )
            return f"{{{space}{inner}{space}}}"
        if isinstance(value, list) and self._chance(0.25):  # over several lines
            lines = [f"[{self._behind(path)}"]
            for number, entry in enumerate(value):
                comma = "," if number < len(value) - 1 or self._chance(0.5) else ""
                lines.append(f"{self._value((*path, number), entry)}{comma}{self._behind(path)}")
            return "\n".join([*lines, "]"])
        if isinstance(value, str) and "#" not in value and self._chance(0.2):
            return f"'''\n{value}'''" if self._chance(0.3) else f"'{value}'"
        return value_text(value)

    def _leaves(self, table: dict[str, Any]) -> list[tuple[list[str], Any]]:
        """Some inner tables as dotted keys, the others whole."""
        found: list[tuple[list[str], Any]] = []
        for key, value in table.items():
            if isinstance(value, dict) and self._chance(0.4):
                found += [([key, *keys], v) for keys, v in self._leaves(value)]
            else:
                found.append(([key], value))
        return found

    def _section(self, path: Path, header: str, table: dict[str, Any]) -> list[str]:
        unit = path[:2] if path[0] in TABLES and path[0] != "camera" else path[:1]
        lines = [*self._above(unit), f"{header}{self._behind(path)}"]
        if unit == path and path[0] in ("objects", "lights"):
            self._pieces.append(("\n".join(lines), path))
        inner: list[str] = []
        for key, value in table.items():
            kind = self._rng.integers(3) if isinstance(value, dict) else 0
            if kind == 1:
                # A comment directly above a header would be the header's material's.
                inner += [""] if path[0] == "materials" or self._chance(0.5) else []
                inner += self._section((*path, key), self._header((*path, key)), value)
            elif kind == 2:
                for keys, v in self._leaves(value):
                    dotted = ".".join(map(self._key, [key, *keys]))
                    lines += self._statement((*path, key, *keys), dotted, v, unit)
            else:
                lines += self._statement((*path, key), self._key(key), value, unit)
        return [*lines, *self._above(unit), *inner]

    def _table(self, key: str, table: dict[str, Any]) -> tuple[list[str], list[list[str]]]:
        """Lines for the part above all sections, and sections."""
        kind = self._rng.integers(4)
        if kind == 0:
            return self._statement((key,), key, table, ()), []
        if kind == 1:
            lines = []
            for keys, value in self._leaves(table):
                dotted = ".".join(map(self._key, [key, *keys]))
                lines += self._statement((key, *keys), dotted, value, ())
            return lines, []
        if kind == 2 or key == "camera":
            return [], [self._section((key,), self._header((key,)), table)]
        return [], [
            self._section((key, name), self._header((key, name)), value)
            for name, value in table.items()
        ]

    def _list(self, key: str, entries: list[Any]) -> list[str]:
        lines = [f"{key} = [{self._behind(())}"]
        for number, entry in enumerate(entries):
            owner = key, number
            comma = "," if number < len(entries) - 1 or self._chance(0.5) else ""
            ahead = comma and self._chance(0.1)
            lines += self._above(owner)
            value = self._value(owner, entry)
            self._pieces.append((value, owner))
            lines.append(f"{self._indent}{value}{'' if ahead else comma}{self._behind(owner)}")
            lines += [comma] if ahead else []
            lines += [""] * self._chance(0.2)
        return [*lines, f"]{self._behind(())}"]
