// Equal segments of `stepMm` from the entry; the last one is shortened to end at the exit. One sample in the middle of each
// segment, with the segment's own length: second order in the step, and exact for a homogeneous medium.
uniform float stepMm;

void traverse(float tEnter, float tExit) {
    vec3 start = ray.texOrigin + tEnter * ray.texDirection;
    float extent = tExit - tEnter;
    //@when jitter
    float first = min(rayOffset() * stepMm, extent);
    vec3 inFirst = start + 0.5 * first * ray.texDirection;
    composeSample(reconstruct(inFirst), inFirst, tEnter + 0.5 * first, first);
    start += first * ray.texDirection;
    tEnter += first;
    extent -= first;
    //@end
    //@when shade
    composeLit(start, tEnter, extent, stepMm);
    //@end
    //@unless shade
    int count = max(int(ceil(extent / stepMm)), 1);
    int i = 0;
    //@when bounds
    ivec2 occupied = occupiedSteps(tEnter, stepMm, count);
    i = occupied.x;
    count = occupied.y;
    //@end
    for (; i < count; ++i) {
        //@when leap
        vec3 next = start + (float(i) + 0.5) * stepMm * ray.texDirection;
        i = min(i + emptySamples(next, stepMm), count - 1);
        //@end
        float from = float(i) * stepMm;
        float lengthMm = max(min(stepMm, extent - from), 0.0);
        float middle = from + 0.5 * lengthMm;
        vec3 p = start + middle * ray.texDirection;
        if (composeSample(reconstruct(p), p, tEnter + middle, lengthMm)) break;
    }
    //@end
}
