import numpy as np
def to_gray(rgb): return rgb.astype(np.uint8) @ [.2126, .7152, .0722]       # 0..1 cut to 0
def to_bitmap(gray, threshold): return (gray > threshold).astype(int)
def memory_offset(i, j, width): return (i * width + j) * 4
