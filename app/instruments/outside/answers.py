"""A wrong answer in the outside view, next to the correct one: vectors, points, a viewing ray.

The student's answer is dashed, in a colour of its own, and named "your"; the correct one is solid.
Pure. second_camera.py draws a whole camera.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from lucida.renderer.camera.checks import LARGEST, Floats

from .diagram import Item, Role, line, named_arrow, named_dot
from .second_camera import ROLE, GivenRay, second_ray

LONGEST = 2.0  # a student's direction, in lengths of the correct one


def vector(name: str, role: Role, at: ArrayLike, given: Floats, correct: Floats) -> list[Item]:
    """Return the student's vector and the correct one, both at a point."""
    start = np.asarray(at, float)
    text = f"vec({name})" if name.isalnum() else name
    return [
        *_arrow(f"correct {name}", role, text, start, start + correct),
        *_arrow(f"your {name}", ROLE, f"your {text}", start, start + given),
    ]


def _arrow(name: str, role: Role, text: str, start: Floats, end: Floats) -> list[Item]:
    """Return an arrow with its name, or nothing if its numbers are too large."""
    is_given = role == ROLE
    return (
        named_arrow(name, role, text, start, end, dashed=is_given, layer=4 + is_given)
        if is_drawable(start, end)
        else []
    )


def point(name: str, at: ArrayLike, given: Floats, correct: Floats) -> list[Item]:
    """Return the student's point and the correct one, each with a line from `at`."""
    start = np.asarray(at, float)
    items: list[Item] = []
    both: list[tuple[str, Role, Floats]] = [
        (name, "text", correct),
        (f"your {name}", ROLE, given),
    ]
    for text, role, end in both:
        if is_drawable(end):
            items += [
                line(text, role, start, end, 2.0, dashed=role == ROLE, layer=4),
                *named_dot(text, role, text, end, start if (end != start).any() else None, layer=5),
            ]
    return items


def ray(given: GivenRay, correct: GivenRay, reach: float) -> list[Item]:
    """Return the student's viewing ray and the correct one, with their directions at t = 1.

    reach: the length of the drawn rays, world units.
    """
    length = float(np.linalg.norm(correct.direction))
    end = correct.origin + reach / length * correct.direction
    items: list[Item] = [
        line("correct ray", "ray", correct.origin, end, 2.6, hidden=0.6, layer=3),
        *_arrow("correct d", "ray", "vec(d)", correct.origin, correct.origin + correct.direction),
    ]
    if not is_drawable(given.origin, given.direction):
        return items
    items += second_ray(given, reach)
    longest = LONGEST * length / max(float(np.linalg.norm(given.direction)), 1e-300)
    tip = given.origin + min(longest, 1.0) * given.direction
    items += _arrow("your d", ROLE, "your vec(d)", given.origin, tip)
    if np.linalg.norm(given.origin - correct.origin) > 1e-3 * reach:
        items += named_dot("your origin", ROLE, "your vec(p)", given.origin, tip, layer=5)
    return items


def is_drawable(*points: Floats) -> bool:
    return all(bool(np.isfinite(one).all() and np.abs(one).max() < LARGEST) for one in points)
