// Light-linear compositing space to sRGB (IEC 61966-2-1), once, at the end.
uniform bool transparentPicture;

vec3 encodeForDisplay(vec3 linear) {
    vec3 low = 12.92 * linear;
    vec3 high = 1.055 * pow(max(linear, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
    return mix(low, high, greaterThan(linear, vec3(0.0031308)));
}

// An associated colour is encoded as the colour it is the association of; a glow without opacity as it is.
vec3 encodePicture(vec3 color, float opacity) {
    if (!transparentPicture) return encodeForDisplay(color);
    return opacity > 0.0 ? encodeForDisplay(color / opacity) * opacity : encodeForDisplay(color);
}
