"""Clicks on the outside view's tools: the legend, and the axes in a corner."""

from __future__ import annotations

from dataclasses import replace

from app.host.view import Host
from app.outside.looking import Floats, camera_along
from app.outside.mouse import Scope
from app.outside.options import OutsideOptions
from app.outside.tools import legend, triad


def use_tools(host: Host, scope: Scope, more: Floats) -> None:
    """Draw the tools into the view's window and do what they are clicked for.

    more: points (n, 3) that must be in sight with the scene.
    """
    state = host.state
    options, clicked = legend(state.of(OutsideOptions), scope.origin, scope.extent)
    axis = triad(scope.shown, scope.origin, scope.extent)
    if clicked == "fit":
        options = replace(options, camera=None)
    elif clicked == "camera":
        options = replace(options, camera=host.renderers.camera(state))
    elif axis is not None:
        options = replace(options, camera=camera_along(host, scope, axis, more))
    if options == state.of(OutsideOptions):
        return
    changed = state.with_options(outside=options)
    if options.camera != state.of(OutsideOptions).camera:
        host.travel(changed)
    else:
        host.apply(changed)
