// Cubic B-spline without prefilter: smooth to the second derivative, does not pass through the voxels.
// Eight linear fetches in place of 64 (Sigg and Hadwiger 2005; Engel et al. 2006, section 9.2).
uniform sampler3D volumeTexture;
uniform vec3 volumeSize;  // voxels

// Along one axis: fetch position of the lower pair, weight of the upper pair, fetch position of the upper pair (texels).
vec3 bsplinePairs(float position) {
    float base = floor(position - 0.5);
    float f = position - 0.5 - base;
    float g = 1.0 - f;
    float w0 = g * g * g / 6.0;
    float w1 = (4.0 + f * f * (3.0 * f - 6.0)) / 6.0;
    float w3 = f * f * f / 6.0;
    float w2 = (4.0 + g * g * (3.0 * g - 6.0)) / 6.0;
    return vec3(base - 0.5 + w1 / (w0 + w1), w2 + w3, base + 1.5 + w3 / (w2 + w3));
}

float reconstruct(vec3 p) {
    vec3 x = bsplinePairs(p.x * volumeSize.x);
    vec3 y = bsplinePairs(p.y * volumeSize.y);
    vec3 z = bsplinePairs(p.z * volumeSize.z);
    vec3 lo = vec3(x.x, y.x, z.x) / volumeSize;
    vec3 hi = vec3(x.z, y.z, z.z) / volumeSize;
    vec4 atLoX = vec4(textureLod(volumeTexture, lo, 0.0).r,
                      textureLod(volumeTexture, vec3(lo.x, hi.y, lo.z), 0.0).r,
                      textureLod(volumeTexture, vec3(lo.xy, hi.z), 0.0).r,
                      textureLod(volumeTexture, vec3(lo.x, hi.yz), 0.0).r);
    vec4 atHiX = vec4(textureLod(volumeTexture, vec3(hi.x, lo.yz), 0.0).r,
                      textureLod(volumeTexture, vec3(hi.xy, lo.z), 0.0).r,
                      textureLod(volumeTexture, vec3(hi.x, lo.y, hi.z), 0.0).r,
                      textureLod(volumeTexture, hi, 0.0).r);
    vec4 alongX = mix(atLoX, atHiX, x.y);
    vec2 alongY = mix(alongX.xz, alongX.yw, y.y);
    return mix(alongY.x, alongY.y, z.y);
}
