"""The kinds of functions that a task can ask for, one per file.

kind         the base class
values       reading what a student's function returned, generously
viewing_ray  the ray of a pixel
basis        a camera's basis from a target
hits         a sphere, a triangle, the nearest of several; their mathematics: shapes
images       gray, one bit per pixel, the place in memory
render       both loops
lenses       a point through a lens, and back
"""

from __future__ import annotations

from lucida.app.checking.kinds.basis import BasisKind
from lucida.app.checking.kinds.hits import ClosestHitKind, SphereHitKind, TriangleHitKind
from lucida.app.checking.kinds.images import BitmapKind, GrayKind, OffsetKind
from lucida.app.checking.kinds.kind import CheckKind
from lucida.app.checking.kinds.lenses import FisheyeKind, ProjectKind, UndistortKind
from lucida.app.checking.kinds.render import RenderKind
from lucida.app.checking.kinds.viewing_ray import ViewingRayKind

# In the order of the lecture, as the built-in tasks.
KINDS: dict[str, CheckKind] = {
    kind.name: kind
    for kind in (
        GrayKind(),
        BitmapKind(),
        OffsetKind(),
        ViewingRayKind(),
        BasisKind(),
        SphereHitKind(),
        TriangleHitKind(),
        ClosestHitKind(),
        RenderKind(),
        ProjectKind(),
        FisheyeKind(),
        UndistortKind(),
    )
}
