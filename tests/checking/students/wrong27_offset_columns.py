def memory_offset(i, j, width):
    return i + j * width
def to_bitmap(gray, threshold):
    return [[1 if g < threshold else 0 for g in row] for row in gray]
