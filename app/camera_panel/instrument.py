"""The camera's panel, as the window takes it."""

from __future__ import annotations

from app.camera_panel.actions import CAMERA, EDIT
from app.camera_panel.view import CameraView
from app.host.instrument import Instrument

INSTRUMENT = Instrument(lambda views: [CameraView()], (*EDIT, *CAMERA))
