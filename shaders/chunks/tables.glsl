// Tables: arrays longer than a texture is wide, wrapped after TABLE_WIDTH texels
// (renderer/raster/tables.py).

ivec2 texel(int index) {
    return ivec2(index & 4095, index >> 12);
}
