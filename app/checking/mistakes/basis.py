"""The lines for a camera's basis from an eye, a target and an up vector, and their mistakes."""

from __future__ import annotations

from app.checking.mistakes.program import CodeLine, Mistake, Program

PART = "The basis from a target"

BASIS_LINES = [
    CodeLine("w", "w = normalized(eye - target)"),
    CodeLine("u", "u = normalized(cross(up, w))"),
    CodeLine("v", "v = cross(w, u)"),
]


def _one(name: str, code: str, hint: str) -> Mistake:
    return Mistake(name, ((code.partition(" ")[0], code),), hint, PART)


BASIS_MISTAKES = [
    _one("w points forwards", "w = normalized(target - eye)",
         "w points back, from the target to the eye: w = (e - a) / |e - a|."),
    _one("the target as a direction", "w = normalized(-target)",
         "The target is a point: the direction to it is a - e, and w points back, e - a."),
    _one("the target as w", "w = normalized(target)",
         "The target is a point. w leads from it to the eye: e - a."),
    _one("the eye as w", "w = normalized(eye)",
         "The eye is a point. w leads to it from the target: e - a."),
    _one("the eye and the target added", "w = normalized(eye + target)",
         "A direction is the difference of two points: e - a."),
    _one("w is not normalised", "w = eye - target", "w has length 1: divide it by its length."),
    _one("w x up for up x w", "u = normalized(cross(w, up))",
         "That is the camera's left: u = up x w, in this order."),
    _one("u is not normalised", "u = cross(up, w)",
         "up x w is shorter than 1 unless up is at right angles to w: normalise it."),
    _one("u from the target", "u = normalized(cross(up, target))",
         "u = up x w: w is the direction back to the eye, not the target."),
    _one("the world's y for up", "u = normalized(cross(vector(0, 1, 0), w))",
         "up is given: it is not always the world's y."),
    _one("the world's z for up", "u = normalized(cross(vector(0, 0, 1), w))",
         "up is given: it is not always the world's z."),
    _one("u x w for w x u", "v = cross(u, w)", "That is upside down: v = w x u, in this order."),
    _one("up used as v", "v = up",
         "up only says which way is up. v is at right angles to w: v = w x u."),
    _one("up, normalised, used as v", "v = normalized(up)",
         "up only says which way is up. v is at right angles to w: v = w x u."),
    _one("v from up, not from u", "v = cross(w, up)", "v = w x u: w x up is a vector to the left."),
]  # fmt: skip

# For a given view direction instead of a target.
FORWARD_LINES = [CodeLine("w", "w = normalized(-forward)"), *BASIS_LINES[1:]]
FORWARD_MISTAKES = [
    _one("w points forwards", "w = normalized(forward)",
         "w points back, against the direction of view: w = -forward."),
    *(one for one in BASIS_MISTAKES if "w" not in one.keys and "target" not in one.name),
]  # fmt: skip

BASIS = Program(
    (*BASIS_LINES, CodeLine("answer", "answer = u, v, w")),
    (
        *BASIS_MISTAKES,
        _one("basis transposed", "answer = columns_of(rows(u, v, w))",
             "Those are rows for columns: u is one vector, not the first numbers of all three."),
        _one("w in its full length", "answer = u, v, eye - target",
             "w has length 1, as u and v: divide it by its length."),
        _one("the view direction for w", "answer = u, v, -w",
             "w points back, from the target to the eye."),
        _one("w, u, v for u, v, w", "answer = w, u, v", "The answer is u, v, w, in this order."),
        _one("v, u, w for u, v, w", "answer = v, u, w", "The answer is u, v, w, in this order."),
    ),
    ("answer",),
)  # fmt: skip
