// Lanczos-windowed sinc of half-width 3: 6 x 6 x 6 voxels, weights normalised to sum 1 (Engel et al. 2006, section 9.2;
// equation 17). Sharp up to near the sampling limit; it rings, and overshoots the local range.
uniform sampler3D volumeTexture;

float sinc(float x) {
    float angle = 3.14159265358979 * x;
    return abs(angle) < 1e-4 ? 1.0 : sin(angle) / angle;  // the parabola left out is below 2e-9
}

struct Taps {
    float weight[6];
};

Taps lanczosTaps(float f) {
    Taps taps;
    float sum = 0.0;
    for (int i = 0; i < 6; ++i) {
        float x = f + 2.0 - float(i);
        taps.weight[i] = sinc(x) * sinc(x / 3.0);
        sum += taps.weight[i];
    }
    for (int i = 0; i < 6; ++i) taps.weight[i] /= sum;
    return taps;
}

float reconstruct(vec3 p) {
    ivec3 last = textureSize(volumeTexture, 0) - 1;
    vec3 position = p * vec3(last + 1) - 0.5;
    vec3 base = floor(position);
    vec3 f = position - base;
    Taps x = lanczosTaps(f.x);
    Taps y = lanczosTaps(f.y);
    Taps z = lanczosTaps(f.z);
    ivec3 first = ivec3(base) - 2;
    float sum = 0.0;
    for (int k = 0; k < 6; ++k) {
        float plane = 0.0;
        for (int j = 0; j < 6; ++j) {
            float row = 0.0;
            for (int i = 0; i < 6; ++i)
                row += x.weight[i] * texelFetch(volumeTexture, clamp(first + ivec3(i, j, k), ivec3(0), last), 0).r;
            plane += y.weight[j] * row;
        }
        sum += z.weight[k] * plane;
    }
    return sum;
}
