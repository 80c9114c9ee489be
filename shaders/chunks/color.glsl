// Display: linear light to sRGB. Source: IEC 61966-2-1.
// Here and in all shaders, constants that are declared nowhere are those of renderer/shared_numbers.py.

vec3 srgb_from_linear(vec3 linear) {
    vec3 low = SRGB_SLOPE * linear;
    vec3 high = SRGB_SCALE * pow(max(linear, vec3(SRGB_LINEAR)), vec3(1.0 / SRGB_GAMMA)) - SRGB_SHIFT;
    return mix(high, low, lessThanEqual(linear, vec3(SRGB_LINEAR)));
}
