// Samples at the segment boundaries, entry and exit included: for surfaces, which are searched between samples.
uniform float stepMm;

void traverse(float tEnter, float tExit) {
    vec3 start = ray.texOrigin + tEnter * ray.texDirection;
    float extent = tExit - tEnter;
    int count = max(int(ceil(extent / stepMm)), 1);
    for (int i = 0; i <= count; ++i) {
        float along = min(float(i) * stepMm, extent);
        vec3 p = start + along * ray.texDirection;
        if (composeSample(reconstruct(p), p, tEnter + along, 0.0)) break;
    }
}
