"""The kinds of functions that a task can ask for, a file a kind.

kind         what all of them have
values       what a student's function returned, read generously
viewing_ray  the ray of a pixel
"""

from __future__ import annotations

from app.checking.kinds.kind import CheckKind
from app.checking.kinds.viewing_ray import ViewingRayKind

KINDS: dict[str, CheckKind] = {kind.name: kind for kind in (ViewingRayKind(),)}
