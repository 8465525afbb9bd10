// The segments and samples of traverse/midpoints_by_four.glsl, each with its gradient.
uniform float stepMm;

void traverse(float tEnter, float tExit) {
    vec3 start = ray.texOrigin + tEnter * ray.texDirection;
    float extent = tExit - tEnter;
    //@when jitter
    float first = min(rayOffset() * stepMm, extent);
    vec3 inFirst = start + 0.5 * first * ray.texDirection;
    composeField(fieldAt(inFirst), inFirst, tEnter + 0.5 * first, first);
    start += first * ray.texDirection;
    tEnter += first;
    extent -= first;
    //@end
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
        vec4 fa = fieldAt(a);
        vec4 fb = fieldAt(b);
        vec4 fc = fieldAt(c);
        vec4 fd = fieldAt(d);
        composeField(fa, a, tEnter + middle, stepMm);
        composeField(fb, b, tEnter + middle + stepMm, stepMm);
        composeField(fc, c, tEnter + middle + 2.0 * stepMm, stepMm);
        if (composeField(fd, d, tEnter + middle + 3.0 * stepMm, stepMm)) return;
        i += 4;
    }
    for (; i < count; ++i) {
        float from = float(i) * stepMm;
        float lengthMm = max(min(stepMm, extent - from), 0.0);
        float middle = from + 0.5 * lengthMm;
        vec3 p = start + middle * ray.texDirection;
        if (composeField(fieldAt(p), p, tEnter + middle, lengthMm)) return;
    }
}
