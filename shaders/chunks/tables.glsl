// Tables: arrays longer than a texture is wide, wrapped after 2^TABLE_SHIFT texels
// (renderer/raster/tables.py).

ivec2 texel(int index) {
    return ivec2(index & ((1 << TABLE_SHIFT) - 1), index >> TABLE_SHIFT);
}
