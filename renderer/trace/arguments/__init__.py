"""What a kernel is given: the camera as plain numbers, the image that it writes, its memory."""
