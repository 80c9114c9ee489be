"""A photograph under or over both images, to compare the camera with a real one."""
