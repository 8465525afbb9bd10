// Equal segments of `stepMm` from the entry, the last one shortened; a value at each boundary, the front one kept from the segment before.
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
    for (int i = 0; i < count; ++i) {
        float from = float(i) * stepMm;
        float to = min(from + stepMm, extent);
        float lengthMm = max(to - from, 0.0);
        vec3 back = start + to * ray.texDirection;
        float uBack = reconstruct(back);
        if (composeSegment(segmentOptics(uFront, uBack, front, back, tEnter + from + 0.5 * lengthMm, lengthMm))) break;
        front = back;
        uFront = uBack;
    }
}
