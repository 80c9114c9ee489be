"""The camera's panel: every number of the camera, presets, look at, copy and paste."""
