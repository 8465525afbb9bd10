// Linear interpolation along each axis in float: texture units may round their weights to 8 bits, which shows as steps
// where a voxel covers more than 256 pixels.
uniform sampler3D volumeTexture;

float reconstruct(vec3 p) {
    ivec3 last = textureSize(volumeTexture, 0) - 1;
    vec3 position = p * vec3(last + 1) - 0.5;
    vec3 base = floor(position);
    vec3 f = position - base;
    ivec3 lo = clamp(ivec3(base), ivec3(0), last);
    ivec3 hi = clamp(ivec3(base) + 1, ivec3(0), last);
    vec4 atLoX = vec4(texelFetch(volumeTexture, lo, 0).r,
                      texelFetch(volumeTexture, ivec3(lo.x, hi.y, lo.z), 0).r,
                      texelFetch(volumeTexture, ivec3(lo.xy, hi.z), 0).r,
                      texelFetch(volumeTexture, ivec3(lo.x, hi.yz), 0).r);
    vec4 atHiX = vec4(texelFetch(volumeTexture, ivec3(hi.x, lo.yz), 0).r,
                      texelFetch(volumeTexture, ivec3(hi.xy, lo.z), 0).r,
                      texelFetch(volumeTexture, ivec3(hi.x, lo.y, hi.z), 0).r,
                      texelFetch(volumeTexture, hi, 0).r);
    vec4 alongX = mix(atLoX, atHiX, f.x);
    vec2 alongY = mix(alongX.xz, alongX.yw, f.y);
    return mix(alongY.x, alongY.y, f.z);
}
