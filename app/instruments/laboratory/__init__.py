"""The image laboratory: one linear image in the representations that the lecture names.

kinds       bitmap, grayscale, colour, half and single float: their bits, bytes and uses
stored      an image stored in a kind, and its look when it is exposed afterwards
light       three projectors whose light adds; test pictures
displays    tube, DLP, LCD and LED in time, whose mean over a cycle is the pixel's colour
array       the array itself: canvas[i, j], row-major or column-major, in Python and Julia
pages       the drawing of each page; view draws it on the screen
"""
