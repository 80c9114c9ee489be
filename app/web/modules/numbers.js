// The numbers of shading and display that both renderers share: renderer/shared_numbers.py.

export const SHORTEST_MEAN = 1e-6; // of vertex normals: a shorter mean is no normal
export const OTHER_SIDE = -1e-5; // vertex normals' sum is on the other side than the winding's
export const GRAZING = 1e-3; // the least cosine between shading normal and viewer
export const CELL_NUDGE = 1e-3; // how far below the surface a checker is evaluated, in cells
export const CHECKERED = 1; // a material's pattern
export const TEXTURED = 2;
export const MIRROR = 1, CLAMP = 2, WRAP_BITS = 2; // a texture's wrap modes
export const TEXEL_BITS = 10;
export const NEAREST_LIGHT = 1e-12; // a nearer light has no direction
export const SHORTEST_HALF = 1e-6; // no highlight for a shorter half vector
export const AWAY = 2e-5; // of shadow and mirror rays from their surface, relative to the scene
export const SRGB_LINEAR = 0.0031308, SRGB_SLOPE = 12.92;
export const SRGB_SCALE = 1.055, SRGB_SHIFT = 0.055, SRGB_GAMMA = 2.4;

/** Return linear light as a byte of sRGB. @param {number} light @param {number} exposure a factor */
export function byteOfLight(light, exposure) {
  const value = Math.min(Math.max(exposure * light, 0), 1);
  const shown = value <= SRGB_LINEAR ? SRGB_SLOPE * value : SRGB_SCALE * value ** (1 / SRGB_GAMMA) - SRGB_SHIFT;
  return Math.floor(shown * 255 + 0.5); // NaN becomes 0 in an array of bytes
}
