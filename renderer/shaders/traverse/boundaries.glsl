// Samples at the segment boundaries, entry and exit included: for surfaces, which are searched between samples.
uniform float stepMm;

void traverse(float tEnter, float tExit) {
    vec3 start = ray.texOrigin + tEnter * ray.texDirection;
    float extent = tExit - tEnter;
    int count = max(int(ceil(extent / stepMm)), 1);
    int last = count;
    int i = 0;
    //@when bounds
    ivec2 occupied = occupiedSteps(tEnter, stepMm, count);
    if (occupied.y == 0) return;
    i = occupied.x;
    count = occupied.y;
    //@end
    for (; i <= count; ++i) {
        //@when leap
        // The last sample that cannot be on the surface is taken: the surface is searched behind it.
        vec3 next = start + min(float(i) * stepMm, extent) * ray.texDirection;
        i = min(i + max(emptySamples(next, stepMm) - 1, 0), count);
        //@end
        // The end itself, not what it rounds to: another part of the ray may begin there, with the same value.
        float t = i == last ? tExit : min(tEnter + float(i) * stepMm, tExit);
        vec3 p = ray.texOrigin + t * ray.texDirection;
        if (composeSample(reconstruct(p), p, t, 0.0)) break;
    }
}
