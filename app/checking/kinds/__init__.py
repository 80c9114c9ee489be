"""The kinds of functions that a task can ask for, one per file.

kind         the base class, and lenient parsing of a student's return values
viewing_ray  the ray of a pixel
basis        a camera's basis from a target
hits         a sphere, a triangle, the nearest of several; their mathematics: shapes
render       both loops: an image
"""

from __future__ import annotations

from .basis import BASIS
from .hits import CLOSEST, SPHERE, TRIANGLE
from .kind import CheckKind
from .render import RENDER
from .viewing_ray import VIEWING_RAY

# The kinds in the order of the lecture and of the built-in tasks.
IN_ORDER: tuple[CheckKind, ...] = (VIEWING_RAY, BASIS, SPHERE, TRIANGLE, CLOSEST, RENDER)
KINDS = {kind.name: kind for kind in IN_ORDER}
