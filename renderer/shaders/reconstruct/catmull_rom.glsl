// Catmull-Rom spline (Catmull and Rom 1974): passes through the voxels and may overshoot the local range.
// The two middle weights are never negative, so they share one linear fetch: 27 fetches in place of 64.
uniform sampler3D volumeTexture;
uniform vec3 volumeSize;  // voxels

struct Taps {
    vec3 place;   // texture coordinates of the three fetches along one axis
    vec3 weight;
};

Taps catmullRomTaps(float coordinate, float size) {
    float position = coordinate * size - 0.5;
    float base = floor(position);
    float f = position - base;
    float w0 = f * (-0.5 + f * (1.0 - 0.5 * f));
    float w1 = 1.0 + f * f * (-2.5 + 1.5 * f);
    float w2 = f * (0.5 + f * (2.0 - 1.5 * f));
    float w3 = f * f * (-0.5 + 0.5 * f);
    Taps taps;
    taps.place = (base + vec3(-0.5, 0.5 + w2 / (w1 + w2), 2.5)) / size;
    taps.weight = vec3(w0, w1 + w2, w3);
    return taps;
}

float reconstruct(vec3 p) {
    Taps x = catmullRomTaps(p.x, volumeSize.x);
    Taps y = catmullRomTaps(p.y, volumeSize.y);
    Taps z = catmullRomTaps(p.z, volumeSize.z);
    float sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        for (int j = 0; j < 3; ++j) {
            float row = 0.0;
            for (int i = 0; i < 3; ++i)
                row += x.weight[i] * textureLod(volumeTexture, vec3(x.place[i], y.place[j], z.place[k]), 0.0).r;
            sum += row * y.weight[j] * z.weight[k];
        }
    }
    return sum;
}
