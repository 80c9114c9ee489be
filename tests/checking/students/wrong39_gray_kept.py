import numpy as np
def to_gray(rgb): return rgb[..., 0] * .0722 + rgb[..., 1] * .7152 + rgb[..., 2] * .2126
def to_bitmap(gray, threshold): return np.where(gray >= threshold, gray, 0)
def memory_offset(i, j, width): return i * (width + j)
