r"""LaTeX as plain text, used if formulas cannot be typeset: \frac{a}{b} becomes a / b.

Bold letters become vec(x), as elsewhere in plain text. Only the commands that lectures use are
supported; unknown ones keep their names without the backslash.
"""

from __future__ import annotations

import re
from collections.abc import Callable

SIGNS = {
    "cdot": "·", "times": "\u00d7", "to": "→", "infty": "∞", "leq": "<=", "geq": ">=", "neq": "!=",
    "quad": "  ", "qquad": "    ", "dots": "...", "ldots": "...", "pm": "±",
    "left": "", "right": "", "lfloor": "floor(", "rfloor": ")", "displaystyle": "",
    ",": " ", ";": " ", ":": " ", "!": "", " ": " ", "|": "|", "\\": "; ",
}  # fmt: skip
# Groups are replaced from the innermost outwards: apply the first matching rule until none matches.
_RULES: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    (r"\\frac<><>", lambda found: f"{_bracketed(found[1])} / {_bracketed(found[2])}"),
    (r"\\sqrt<>", r"sqrt(\1)"),
    (r"\\mathbf\{(\w)\}", r"vec(\1)"),
    (r"\\hat<>", r"\1/|\1|"),
    (r"\\(?:text|fg|bg)color<><>", r"\2"),
    (r"\\color<>", ""),
    (r"\\(?:math[a-z]+|text|boldsymbol|vec)<>", r"\1"),
    (r"\^(?:2|\{2\})", "²"),
    (r"\^(?:3|\{3\})", "³"),
    (r"([_^])<>", lambda found: found[1] + _bracketed(found[2])),
    (r"<>", r"\1"),
)
_GROUPS = tuple((re.compile(rule.replace("<>", r"\{([^{}]*)\}")), text) for rule, text in _RULES)
_BRACES = {r"\{": "\ue000", r"\}": "\ue001"}  # visible braces


def plain_math(latex: str) -> str:
    """Return the formula in one line of plain text."""
    text, count = latex, 1
    for brace, kept in _BRACES.items():
        text = text.replace(brace, kept)
    while count:
        for rule, shown in _GROUPS:
            text, count = rule.subn(shown, text, count=1)
            if count:
                break
    text = re.sub(r"\\([A-Za-z]+|.)", lambda found: SIGNS.get(found[1], found[1]), text)
    text = text.replace("\ue000", "{").replace("\ue001", "}")
    return re.sub(r" {3,}", "  ", re.sub(r"\s*\n\s*", " ", text)).strip()


def _bracketed(text: str) -> str:
    """Enclose sums and products in brackets; return single terms unchanged."""
    text = text.strip()
    return text if re.fullmatch(r"[\w.²³]*|\|[^|]*\||\([^()]*\)", text) else f"({text})"
