// Equal segments of `stepMm` from the entry, the last one shortened; a value at each boundary, the front one kept from the segment before.
// With leaps four segments a look are taken; those behind the end have no length.
uniform float stepMm;

void traverse(float tEnter, float tExit) {
    vec3 front = ray.texOrigin + tEnter * ray.texDirection;
    float uFront = reconstruct(front);
    vec3 start = front;
    float extent = tExit - tEnter;
    //@when jitter
    float first = min(rayOffset() * stepMm, extent);
    start += first * ray.texDirection;
    float uStart = reconstruct(start);
    composeSegment(segmentOptics(uFront, uStart, front, start, tEnter + 0.5 * first, first));
    front = start;
    uFront = uStart;
    tEnter += first;
    extent -= first;
    //@end
    int count = max(int(ceil(extent / stepMm)), 1);
    int i = 0;
    //@when bounds
    ivec2 occupied = occupiedSteps(tEnter, stepMm, count);
    i = occupied.x;
    count = occupied.y;
    // The boundary as the segment before computes its back.
    front = start + (i > 0 ? min(float(i - 1) * stepMm + stepMm, extent) : 0.0) * ray.texDirection;
    uFront = reconstruct(front);
    //@end
    while (i < count) {
        //@when leap
        int leap = 1;
        while (leap > 0 && i < count) {
            leap = emptySegments(start + float(i) * stepMm * ray.texDirection, stepMm);
            leap = leap < 4 ? 0 : leap;
            i += leap;
        }
        // Leapt to the end: the last segment is taken in vain rather than asked for.
        i = min(i, count - 1);
        front = start + (i > 0 ? min(float(i - 1) * stepMm + stepMm, extent) : 0.0) * ray.texDirection;
        uFront = reconstruct(front);
        for (int k = 0; k < 4; ++k) {
        //@end
        float from = float(i) * stepMm;
        float to = min(from + stepMm, extent);
        float lengthMm = max(to - from, 0.0);
        vec3 back = start + to * ray.texDirection;
        float uBack = reconstruct(back);
        if (composeSegment(segmentOptics(uFront, uBack, front, back, tEnter + from + 0.5 * lengthMm, lengthMm))) return;
        front = back;
        uFront = uBack;
        ++i;
        //@when leap
        }
        //@end
    }
}
