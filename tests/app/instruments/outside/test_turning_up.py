"""The basis that follows from **up**, and where there is none."""

from __future__ import annotations

import numpy as np
import pytest

from lucida.app.instruments.outside.camera_diagram import Content, diagram
from lucida.app.instruments.outside.diagram import Label
from lucida.app.instruments.outside.gizmo import with_up
from lucida.app.state.options.outside import OutsideOptions
from lucida.renderer.camera.camera import Camera

CAMERA = Camera.look_at((3.2, 1.6, 3.8), (0, 0, 0), fov_y_deg=35.0, aspect=1.0)


@pytest.mark.parametrize("up", [(0, 2, 0), (1, 0.2, 0), (-0.3, -1, 0.4)])
def test_u_is_at_right_angles_to_up_and_w(up):
    camera, kept = with_up(CAMERA, CAMERA, np.array(up, float))
    assert kept == up
    assert camera.w == CAMERA.w
    u, v, w = np.array(camera.u), np.array(camera.v), np.array(camera.w)
    assert np.allclose([u @ up, u @ w, v @ w, u @ v], 0, atol=1e-12)
    assert v @ up > 0
    assert np.linalg.det([u, v, w]) > 0


@pytest.mark.parametrize("sign", [1, -1])
def test_up_along_w_has_no_basis(sign):
    almost = sign * 2 * np.array(CAMERA.w) + 0.02 * np.array(CAMERA.u)
    camera, up = with_up(CAMERA, CAMERA, almost)
    assert camera == CAMERA
    options = OutsideOptions(target=(0, 0, 0), up=up, volume=False, image=False, grid=False)
    names = {item.name for item in diagram(Content(CAMERA, (8, 8), options, 10.0))}
    assert {"w", "up", "fails"} <= names
    assert not {"u", "v", "up and w"} & names
    upright = diagram(Content(CAMERA, (8, 8), OutsideOptions(target=(0, 0, 0)), 10.0))
    labels = {item.name for item in upright if isinstance(item, Label)}
    assert {"u", "v", "w", "up"} <= labels
