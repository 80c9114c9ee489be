def to_gray(rgb):
    return [[(0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]) for p in row] for row in rgb]

def to_bitmap(gray, threshold):
    return [[1 if g >= threshold else 0 for g in row] for row in gray]

def memory_offset(i, j, width):
    return j + width * i
