"""The camera's panel, as an instrument of the window."""

from __future__ import annotations

from app.cameras.camera_panel.actions import CAMERA, EDIT
from app.cameras.camera_panel.view import CameraView
from app.ui.instrument import Instrument

SYNONYMS = {
    "Copy camera": "matrix clipboard",
    "Paste camera": "matrix clipboard",
    "Parallel projection": "ortho orthographic orthogonal perspective",
    "Keep orthonormal": "orthogonal basis skew free",
    "Fit to the image's aspect ratio": "stretch distort viewport",
    "Scene's view": "home reset camera default",
    "Canonical camera": "reset default identity",
    "Aim at the object under the mouse": "focus center centre target look",
    "Frame the scene": "all extents fit view",
    "Barrel": "lens distortion brown",
    "Pincushion": "lens distortion brown",
    "Phone": "lens distortion brown",
    "Action cam": "lens action camera gopro fisheye wide angle distortion",
    "190 degrees": "lens fisheye circular wide angle",
    "360 degrees": "lens panorama equirectangular spherical",
    "No lens": "pinhole undistort",
    "Jump without transition": "animation reduced motion transition",
    "Camera": "fov field of view eye basis viewport distance near far clip dolly zoom",
}

INSTRUMENT = Instrument(lambda views: [CameraView()], (*EDIT, *CAMERA), synonyms=SYNONYMS)
