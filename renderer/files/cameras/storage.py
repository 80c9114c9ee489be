"""Tables of named values: OpenCV's FileStorage (YAML, JSON, XML), ROS's YAML, and pasted text.

Parses the notations, and returns plain Python values: numbers, texts and lists.
"""

from __future__ import annotations

import json
import re
from typing import Any
from xml.etree import ElementTree

import numpy as np

from lucida.renderer.files.cameras.given import Given, from_json
from lucida.renderer.files.cameras.literals import values_in
from lucida.renderer.files.reading import check_bytes
from lucida.renderer.system.errors import LucidaError

Table = dict[str, Any]

MOST_BYTES = 1 << 19  # a calibration of some thousand corners; YAML is slow to parse

# Only in YAML: a matrix by its parts, or names and numbers on lines below a name.
_YAML = re.compile(
    r"^\s*(?:rows|data)\s*:|^\w+:[ \t]*\r?\n(?:[ \t]+\w+:|[ \t]*-[ \t])", re.MULTILINE
)
_PYTHON = re.compile(r"\s*\{\s*'")  # a printed dictionary
# ROS's .ini: names and numbers on lines below a name.
_INI = re.compile(r"^([a-z][a-z ]*)[ \t]*\n((?:[ \t]*\n|[-+\d.eE \t]+(?:\n|\Z))+)", re.MULTILINE)
_INI_NAMES = {"projection": "projection_matrix"}


def table_in(given: Given) -> Table:
    """Return the values of a file or a text, by their names. Raises LucidaError."""
    check_bytes(len(given.data), MOST_BYTES, given.name)
    text = given.text
    if is_ini(text):
        found = _INI.findall(text)
        table = {_INI_NAMES.get(name, name): _words(words) for name, words in found}
        if len(table) < len(found):
            raise LucidaError("", "holds several cameras", "give each camera a file of its own")
        return table
    if given.ending == ".json" or (text.lstrip()[:1] == "{" and not _PYTHON.match(text)):
        table = from_json(text)
    elif text.lstrip()[:1] == "<":
        table = _from_xml(text)
    elif given.ending in (".yml", ".yaml") or text[:5] == "%YAML" or _YAML.search(text):
        from lucida.renderer.files.cameras.plain_yaml import from_yaml  # late: few files are YAML

        table = from_yaml(text)
    else:
        table = values_in(text)
    if not isinstance(table, dict):
        raise LucidaError("", "holds no names with values", "give e.g. camera_matrix: ...")
    values: Table = _value(table)
    return values


def is_ini(text: str) -> bool:
    return "[image]" in text and _INI.search(text) is not None


def to_yaml(table: Table, comments: list[str]) -> str:
    """Return YAML as cv2.FileStorage writes it. table: numbers, texts and matrices (rows,
    columns).
    """
    lines = ["%YAML:1.0", "---", *(f"# {comment}" for comment in comments)]
    for name, value in table.items():
        if isinstance(value, np.ndarray):
            numbers = ", ".join(f"{x:.16e}" for x in value.ravel().tolist())
            rows, cols = value.shape
            lines += [f"{name}: !!opencv-matrix", f"   rows: {rows}", f"   cols: {cols}"]
            lines += ["   dt: d", f"   data: [ {numbers} ]"]
        else:
            lines.append(f"{name}: {json.dumps(value)}")
    return "\n".join(lines) + "\n"


def _value(value: Any) -> Any:
    """Return a value in which a table that has data is only its data: a matrix, row by row."""
    if not isinstance(value, dict):
        return value
    if "data" in value:
        return value["data"]
    return {str(name): _value(part) for name, part in value.items()}


def _from_xml(text: str) -> Any:
    """Parse XML without declarations, which might expand without end. Raises LucidaError."""
    if "<!" in re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL):
        raise LucidaError("", "holds a declaration (<!)", "give the program's own XML")
    try:
        root = ElementTree.fromstring(text.encode())
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        problem = f"is no XML: {error}"
        raise LucidaError("", problem, "correct it there") from None
    if root.tag != "opencv_storage":
        problem = f"is XML of another kind: {root.tag}"
        raise LucidaError("", problem, "give OpenCV's <opencv_storage>")
    return {entry.tag: _of_element(entry) for entry in root}


def _of_element(element: ElementTree.Element) -> Any:
    if not len(element):
        return _words(element.text or "")
    parts = [(part.tag, _of_element(part)) for part in element]
    if parts[0][0] == "_":  # a sequence
        return [value for _, value in parts]
    return dict(parts)


def _words(text: str) -> Any:
    words = [_word(word) for word in text.split()]
    return words[0] if len(words) == 1 else words


def _word(word: str) -> Any:
    for kind in (int, float):
        try:
            return kind(word)
        except ValueError:
            continue
    return word
