"""YAML as calibration files use it: plain values, and OpenCV's matrices as tables of their
parts.
"""

from __future__ import annotations

import re
from typing import Any

import yaml

from lucida.renderer.system.errors import LucidaError

# OpenCV's own YAML needs no space after a name: "key:2".
_TIGHT = re.compile(r"^(\s*[A-Za-z][\w.]*):(?=[^\s:/])", re.MULTILINE)
_DIRECTIVE = re.compile(r"\A%YAML[^\n]*\n?")  # OpenCV's "%YAML:1.0" is not a valid directive


def from_yaml(text: str) -> Any:
    """Parse YAML of one document; empty ones are ignored. Raises LucidaError."""
    if _DIRECTIVE.match(text):
        text = _TIGHT.sub(r"\1: ", _DIRECTIVE.sub("\n", text))
    try:
        documents = [part for part in yaml.load_all(text, _PlainYaml) if part is not None]
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark
        where = f"line {mark.line + 1}, column {mark.column + 1}" if mark else ""
        raise LucidaError(where, error.problem or "is no YAML", "correct the YAML there") from None
    except yaml.YAMLError:
        raise LucidaError("", "holds characters that YAML has not", "save it anew") from None
    except RecursionError:
        raise LucidaError("", "is nested too deeply", "write it with fewer brackets") from None
    except (ValueError, OverflowError):  # an impossible number or date
        raise LucidaError("", "holds a number that cannot be", "correct it") from None
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
