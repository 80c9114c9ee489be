"""The handles of the other camera, as the outside view has them in a frame."""

from __future__ import annotations

from app.host.view import Host
from app.outside.gizmo import Gizmo
from app.outside.mouse import Scope
from app.outside.options import OutsideOptions
from app.widgets import theme


def handles(gizmo: Gizmo, host: Host, scope: Scope, ground: theme.Rgb) -> None:
    """Draws those that are chosen into the current window; the camera follows them. ground: what
    they are drawn on."""
    state = host.state
    kind = state.of(OutsideOptions).gizmo
    if kind == "none":
        gizmo.over = False
        gizmo.cancel()
        return
    camera = gizmo.draw(scope, state.camera, kind, state.keep_orthonormal, ground, host.fonts)
    if camera != state.camera:
        host.apply(state.with_camera(camera), gizmo.gesture)
    if gizmo.dragging:
        host.animate()
