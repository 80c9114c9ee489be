"""A kernel's arguments: the camera as plain numbers, the image that it writes, its memory."""
