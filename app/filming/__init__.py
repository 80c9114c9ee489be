"""Films from the window: a path of the camera, seen in the outside view, and a film along it."""
