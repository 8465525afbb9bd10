// Pre-classification (Engel et al. 2006, section 4.1.2; equation 21 of docs/equations.md), for comparison: the transfer function is applied to
// the eight voxels around, and their associated colours are interpolated. What the function does between two voxels is lost.
uniform sampler1D transferTable;   // RGB in the compositing space, extinction per unit length
uniform vec2 tableFromValue;       // table coordinate = u * x + y
uniform float extinctionPerMm;     // density scale / unit length

// Colour times extinction, so that a transparent voxel lends no colour.
vec4 associatedVoxel(ivec3 voxel) {
    float u = texelFetch(volumeTexture, voxel, 0).r;
    vec4 entry = textureLod(transferTable, u * tableFromValue.x + tableFromValue.y, 0.0);
    return vec4(entry.rgb * entry.a, entry.a);
}

vec4 classifySample(float u, vec3 p) {
    ivec3 last = textureSize(volumeTexture, 0) - 1;
    vec3 position = p * vec3(last + 1) - 0.5;
    vec3 base = floor(position);
    vec3 f = position - base;
    ivec3 lo = clamp(ivec3(base), ivec3(0), last);
    ivec3 hi = clamp(ivec3(base) + 1, ivec3(0), last);
    vec4 front = mix(mix(associatedVoxel(lo), associatedVoxel(ivec3(hi.x, lo.yz)), f.x),
                     mix(associatedVoxel(ivec3(lo.x, hi.y, lo.z)), associatedVoxel(ivec3(hi.xy, lo.z)), f.x), f.y);
    vec4 back = mix(mix(associatedVoxel(ivec3(lo.xy, hi.z)), associatedVoxel(ivec3(hi.x, lo.y, hi.z)), f.x),
                    mix(associatedVoxel(ivec3(lo.x, hi.yz)), associatedVoxel(hi), f.x), f.y);
    vec4 mean = mix(front, back, f.z);
    return vec4(mean.a > 0.0 ? mean.rgb / mean.a : vec3(0.0), mean.a * extinctionPerMm);
}
