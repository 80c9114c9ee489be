"""The image laboratory: one linear image in the representations that the lecture names.

kinds       bitmap, grayscale, colour, half and single float: bits, bytes, what each is good for
bitmaps     one bit per pixel: threshold, ordered dither, Floyd-Steinberg
stored      an image as it is kept in a kind, and what is seen when it is exposed afterwards
light       three projectors whose light adds; test pictures
displays    tube, DLP, LCD and LED in time, whose mean over a cycle is the pixel's colour
memory      the array itself: canvas[i, j], row-major or column-major, memory offsets
array_code  the same as a program, in Python and Julia
pages       which pictures each page shows; view, tools, tables, ...: on the screen
"""
