"""Tables of named values: OpenCV's FileStorage (YAML, JSON, XML), ROS's YAML and .ini, and pasted
text such as `K = np.array([[800, 0, 320], ...])`, as NumPy, Python, C and MATLAB write it.

The parsers return plain Python values: numbers, texts and lists. Nothing is executed. A calculation
with the numbers is an error, because the numbers alone would be wrong.
"""

from __future__ import annotations

import json
import re
from typing import Any
from xml.etree import ElementTree

import numpy as np
import yaml

from lucida.renderer.files.reading import check_bytes
from lucida.renderer.system.errors import LucidaError

from .given import Given, from_json

Table = dict[str, Any]

MOST_BYTES = 1 << 19  # a calibration of some thousand corners; YAML is slow to parse

# Only YAML has a matrix by its parts, or names and numbers on lines below a name.
_YAML = re.compile(
    r"^\s*(?:rows|data)\s*:|^\w+:[ \t]*\r?\n(?:[ \t]+\w+:|[ \t]*-[ \t])", re.MULTILINE
)
_PYTHON = re.compile(r"\s*\{\s*'")  # a printed dictionary
# ROS's .ini: names and numbers on lines below a name.
_INI = re.compile(r"^([a-z][a-z ]*)[ \t]*\n((?:[ \t]*\n|[-+\d.eE \t]+(?:\n|\Z))+)", re.MULTILINE)
_INI_NAMES = {"projection": "projection_matrix"}
# OpenCV's own YAML needs no space after a name: "key:2".
_TIGHT = re.compile(r"^(\s*[A-Za-z][\w.]*):(?=[^\s:/])", re.MULTILINE)
_DIRECTIVE = re.compile(r"\A%YAML[^\n]*\n?")  # OpenCV's "%YAML:1.0" is not a valid directive
_COMMENT = re.compile(r"(?:#|//|%)[^\n]*")
_NAME = re.compile(
    r"""(?:^|;|\{|,)[ \t]*["']?(?!(?:dtype|device|elements|data)\b)([A-Za-z_](?: ?[\w.]){0,60})"""
    r"""["']?[ \t]*(?:\[\s*\d*\s*\]\s*)*(?:=(?!=)|:)""",
    re.MULTILINE,
)
# Text around numbers that changes none of them: keywords, shapes and calls.
_KEYWORD = re.compile(
    r"""["']?\b(?:dtype|device|elements|data)["']?\s*[=:](?:\s*[\w.'":]+)?|\.reshape\([^)]*\)"""
)
_CALL = re.compile(r"[A-Za-z_][\w.:]*\s*(?=\()")
# Matrices as people type them: np.eye(3), numpy.identity(4), np.zeros(3), np.zeros((3, 1)), eye(3).
_MADE = re.compile(r"(?:\w+\.)?(eye|identity|zeros)\(\s*\(?\s*(\d)\s*(?:,\s*(\d)\s*)?\)?\s*\)")
_NUMBER = re.compile(r"[-+]?(?:(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?|nan|inf)", re.IGNORECASE)
_BETWEEN = re.compile(r"(?:(?<=[\d.])f)?[\s\[\](){},;]+|(?<=\d)x(?=\d)")
_WORD = re.compile(r"""["']?([A-Za-z][\w-]*)["']?[\s,;}]*""")


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
        table = _from_yaml(text)
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
    """Return a value with each table that has data (a matrix) replaced by its data, row by row."""
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
        problem = f"is not XML: {error}"
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


def _from_yaml(text: str) -> Any:
    """Parse YAML of one document; empty ones are ignored. Raises LucidaError."""
    if _DIRECTIVE.match(text):
        text = _TIGHT.sub(r"\1: ", _DIRECTIVE.sub("\n", text))
    try:
        documents = [part for part in yaml.load_all(text, _PlainYaml) if part is not None]
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark
        where = f"line {mark.line + 1}, column {mark.column + 1}" if mark else ""
        raise LucidaError(where, error.problem or "is not YAML", "correct the YAML there") from None
    except yaml.YAMLError:
        raise LucidaError("", "holds characters that YAML does not allow", "save it anew") from None
    except RecursionError:
        raise LucidaError("", "is nested too deeply", "write it with fewer brackets") from None
    except (ValueError, OverflowError):  # an impossible number or date
        raise LucidaError("", "holds an impossible number", "correct it") from None
    if len(documents) > 1:
        problem = f"holds {len(documents)} documents, separated by ---"
        raise LucidaError("", problem, "give each camera a file of its own")
    return documents[0] if documents else None


class _PlainYaml(yaml.SafeLoader):
    """A loader for plain values only. Aliases are errors: expanding them might never end."""

    def compose_node(self, parent: Any, index: Any) -> Any:
        if self.check_event(yaml.AliasEvent):
            mark = self.peek_event().start_mark
            raise yaml.composer.ComposerError(None, None, "holds an alias (*)", mark)
        return super().compose_node(parent, index)


# 1e-05, which YAML 1.1 reads as text.
_PlainYaml.add_implicit_resolver(
    "tag:yaml.org,2002:float",
    re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)[eE][-+]?\d+\Z"),
    list("-+.0123456789"),
)
for _tag in ("opencv-matrix", "opencv-nd-matrix"):
    _PlainYaml.add_constructor(
        f"tag:yaml.org,2002:{_tag}", lambda loader, node: loader.construct_mapping(node, deep=True)
    )


def assigned(text: str) -> dict[str, str]:
    """Return the text assigned to each name, up to the next name. The last assignment counts."""
    text = _COMMENT.sub("", text)
    names = list(_NAME.finditer(text))
    ends = [*(name.start() for name in names[1:]), len(text)]
    return {name[1]: text[name.end() : end] for name, end in zip(names, ends, strict=False)}


def values_in(text: str) -> dict[str, Any]:
    """Return the numbers, flat lists of numbers, and single words that a text assigns to names.

    Raises LucidaError.
    """
    values = {name: value_of(name, value) for name, value in assigned(text).items()}
    return {name: value for name, value in values.items() if value is not None}


def value_of(name: str, text: str) -> Any:
    """Return the value in a text; None if it is neither numbers nor a word. Raises LucidaError."""
    if alone := _WORD.fullmatch(text.strip()):
        return alone[1]
    text = _CALL.sub("", _MADE.sub(_made, _KEYWORD.sub("", text))).strip()
    if text[:1] not in tuple("[({") and not _NUMBER.match(text):
        return None
    if sum(map(text.count, "[({")) > sum(map(text.count, "])}")):
        raise LucidaError(name, "has a bracket that is not closed", "give numbers in brackets")
    words = [word for word in _BETWEEN.split(text) if word]
    for word in words:
        if not _NUMBER.fullmatch(word):
            problem = f"continues with {word[:30]!r} after its numbers"
            raise LucidaError(name, problem, "give the numbers alone")
    numbers = list(map(float, words))
    return numbers[0] if len(numbers) == 1 else numbers


def _made(call: re.Match[str]) -> str:
    """Return the numbers that eye(), identity() or zeros() makes."""
    if call[1] == "zeros":
        return str([0.0] * (int(call[2]) * int(call[3] or 1)))
    return str(np.eye(int(call[2]), int(call[3] or call[2])).ravel().tolist())
