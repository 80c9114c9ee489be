r"""LaTeX as plain text, for where formulas cannot be typeset: \frac{a}{b} as a / b.

Bold letters are vec(x), as elsewhere in plain text. It supports only the commands that lectures
use; unknown ones keep their names without the backslash.
"""

from __future__ import annotations

import re

SIGNS = {
    "cdot": "·", "times": "\u00d7", "to": "→", "infty": "∞", "leq": "<=", "geq": ">=", "neq": "!=",
    "quad": "  ", "qquad": "    ", "dots": "...", "ldots": "...", "pm": "±",
    "left": "", "right": "", "lfloor": "floor(", "rfloor": ")", "displaystyle": "",
    ",": " ", ";": " ", ":": " ", "!": "", " ": " ", "{": "{", "}": "}", "|": "|", "\\": "; ",
}  # fmt: skip
_TOKEN = re.compile(r"\\([A-Za-z]+|.)|([{}])|(\^|_)|([^\\{}^_]+)", re.DOTALL)
_STYLES = ("mathrm", "mathbb", "mathit", "text", "boldsymbol", "vec")


def plain_math(latex: str) -> str:
    """Return the formula in one line of plain text."""
    text = _LatexReader(latex).until_end()
    return re.sub(r" {3,}", "  ", re.sub(r"\s*\n\s*", " ", text)).strip()


class _LatexReader:
    """Reads tokens from the left, with one method per construct."""

    def __init__(self, latex: str) -> None:
        self._tokens = list(_TOKEN.finditer(latex))
        self._at = 0

    def until_end(self, closing: bool = False) -> str:
        """Return the text up to the end, or to the brace that closes the group."""
        parts: list[str] = []
        while self._at < len(self._tokens):
            token = self._tokens[self._at]
            if token[2] == "}" and closing:
                self._at += 1
                break
            parts.append(self._one())
        return "".join(parts)

    def _one(self) -> str:
        token = self._tokens[self._at]
        self._at += 1
        command, brace, script, text = token.groups()
        if text is not None:
            return str(text)
        if brace is not None:
            return self.until_end(closing=True) if brace == "{" else ""
        if script is not None:
            raised = self._argument()
            if script == "^" and raised in ("2", "3"):
                return "²" if raised == "2" else "³"
            return script + _bracketed(raised)
        if command == "frac":
            return f"{_bracketed(self._argument())} / {_bracketed(self._argument())}"
        if command == "sqrt":
            return f"sqrt({self._argument()})"
        if command in ("textcolor", "color"):
            self._argument()
            return self._argument() if command == "textcolor" else ""
        if command == "mathbf":
            name = self._argument()
            return f"vec({name})" if len(name) == 1 else name
        if command == "hat":  # a unit vector
            name = self._argument()
            return f"{name}/|{name}|"
        if command in _STYLES:
            return self._argument()
        return SIGNS.get(command, command)

    def _argument(self) -> str:
        """Read a group, a command, or the next character."""
        if self._at >= len(self._tokens):
            return ""
        token = self._tokens[self._at]
        if token[4] is None:
            return self._one()
        text = token[4].lstrip()
        self._at += 1
        if len(text) > 1:  # only its first character: the rest is read again
            self._tokens.insert(self._at, _TOKEN.match(text[1:]))  # type: ignore[arg-type]
        return text[:1]


def _bracketed(text: str) -> str:
    """Return sums and products in brackets, single terms without."""
    text = text.strip()
    return text if re.fullmatch(r"[\w.²³]*|\|[^|]*\||\([^()]*\)", text) else f"({text})"
