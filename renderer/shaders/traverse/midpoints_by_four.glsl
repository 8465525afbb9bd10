// The same samples as `midpoints`, four a turn without a condition between them: where a value is one fetch, the turn of the loop
// costs a fifth of it (measured on llvmpipe; a GPU overlaps the four fetches). A ray that may end early is asked once a turn.
// Leaps go over whole turns, so that the samples are grouped, and rays end, as they do without leaps.
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
    int whole = (count - 1) & ~3;
    int i = 0;
    //@when bounds
    ivec2 occupied = occupiedSteps(tEnter, stepMm, count);
    i = min(occupied.x & ~3, whole);
    whole = min(whole, (occupied.y + 3) & ~3);
    count = occupied.y;
    //@end
    vec3 advance = stepMm * ray.texDirection;
    while (i < whole) {
        //@when leap
        int leap = 4;
        while (leap > 0 && i < whole) {
            leap = emptySamples(start + (float(i) + 0.5) * stepMm * ray.texDirection, stepMm) & ~3;
            i += leap;
        }
        // Leapt to the end: the last four are taken in vain rather than asked for.
        i = min(i, whole - 4);
        //@end
        float middle = (float(i) + 0.5) * stepMm;
        vec3 a = start + middle * ray.texDirection;
        vec3 b = a + advance;
        vec3 c = b + advance;
        vec3 d = c + advance;
        float ua = reconstruct(a);
        float ub = reconstruct(b);
        float uc = reconstruct(c);
        float ud = reconstruct(d);
        composeSample(ua, a, tEnter + middle, stepMm);
        composeSample(ub, b, tEnter + middle + stepMm, stepMm);
        composeSample(uc, c, tEnter + middle + 2.0 * stepMm, stepMm);
        if (composeSample(ud, d, tEnter + middle + 3.0 * stepMm, stepMm)) return;
        i += 4;
    }
    for (; i < count; ++i) {
        float from = float(i) * stepMm;
        float lengthMm = max(min(stepMm, extent - from), 0.0);
        float middle = from + 0.5 * lengthMm;
        vec3 p = start + middle * ray.texDirection;
        if (composeSample(reconstruct(p), p, tEnter + middle, lengthMm)) return;
    }
    //@end
}
