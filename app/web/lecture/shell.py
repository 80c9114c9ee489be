"""The parts of a lecture's page around its steps: the bar, the overview, answers, keys."""

from __future__ import annotations

from lucida.app.lecture.model import Lecture

from .text import plain

BAR = """<nav aria-label="Steps">
<button type="button" id="previous">Previous</button>
<output id="place"></output>
<button type="button" id="next">Next</button>
</nav>
<div class="tools">
<button type="button" id="open-overview">Overview</button>
<button type="button" id="open-notes">Notes</button>
<button type="button" id="open-answers">Answers</button>
<button type="button" id="theme">Theme</button>
<button type="button" id="print">Print</button>
<button type="button" id="open-help">Keys</button>
</div>
"""

KEYS = (
    ("Page Down, Right, Space", "on"),
    ("Page Up, Left, Shift+Space", "back"),
    ("Home, End", "first and last step"),
    ("O", "overview"),
    ("N", "notes, in a window of its own"),
    ("T", "theme: dark, light, high contrast"),
    ("B or full stop", "blank screen"),
    ("Esc", "close"),
)

_CLOSE = '<form method="dialog"><button>Close</button></form></dialog>\n'
_ROWS = "".join(f"<dt>{key}</dt><dd>{does}</dd>" for key, does in KEYS)
DIALOGS = f"""<dialog id="answers" aria-labelledby="answers-title">
<h2 id="answers-title">Answers</h2>
<p><output id="kept"></output> kept in this page. Nothing is sent.</p>
<p><label for="student">Name (optional)</label> <input id="student" type="text" maxlength="60"
autocomplete="name"></p>
<p><button type="button" id="save">Save for the lecturer</button>
<button type="button" id="forget">Forget all answers</button></p>
{_CLOSE}<dialog id="help" aria-labelledby="help-title">
<h2 id="help-title">Keys</h2>
<dl class="keys">{_ROWS}</dl>
<p><label><input type="checkbox" id="letters" checked> Single-letter shortcuts</label></p>
{_CLOSE}<p id="told" class="unseen" role="status"></p>
"""


def overview(lecture: Lecture) -> str:
    """Return the overview: all steps in their parts."""
    parts = []
    for title, numbers in lecture.outline():
        items = "".join(
            f'<li><a href="#{k + 1}"><span class="number">{k + 1}</span> '
            f"{plain(lecture.steps[k].title)}</a></li>\n"
            for k in numbers
        )
        heading = f"<h3>{plain(title)}</h3>\n" if title else ""
        parts.append(f"{heading}<ul>\n{items}</ul>\n")
    return (
        '<dialog id="overview" aria-labelledby="overview-title">\n'
        f'<h2 id="overview-title">Overview</h2>\n{"".join(parts)}{_CLOSE}'
    )
