// Emission-absorption, one sample a segment.
void composeBegin() {
    accumulateBegin();
}

// Colour of a sample that is not lit yet, and its optical depth.
vec4 sampleOptics(float u, vec3 p, float lengthMm) {
    return integrateSample(u, p, lengthMm);
}

bool composeOptics(vec4 optical, vec3 p, float t) {
    //@when shade
    if (optical.a > 0.0)
        optical.rgb = shade(optical.rgb, gradientMm(p), ray.origin + t * ray.direction, -ray.direction);
    //@end
    accumulate(optical.rgb, optical.a);
    //@when terminate
    if (rayIsDone(transmittance)) return true;
    //@end
    return false;
}

bool composeSample(float u, vec3 p, float t, float lengthMm) {
    return composeOptics(sampleOptics(u, p, lengthMm), p, t);
}

//@when shade
// All midpoints of a ray whose samples are lit. A lit sample costs seven or more fetches, a transparent one need not be lit: an inner
// loop passes over those, so that rays drawn side by side meet at their visible samples and no branch has to be skipped
// (software rasterisers skip none). The condition stands first: Mesa 22.3 compiles the same as do ... while wrongly
// (lanes that are done go on).
void composeLit(vec3 start, float tEnter, float extent, float segmentMm) {
    int count = max(int(ceil(extent / segmentMm)), 1);
    int next = 0;
    //@when bounds
    ivec2 occupied = occupiedSteps(tEnter, segmentMm, count);
    next = occupied.x;
    count = occupied.y;
    //@end
    while (next < count) {
        vec4 optical = vec4(0.0);
        float middle = 0.0;
        while (optical.a <= 0.0 && next < count) {
            //@when leap
            vec3 ahead = start + (float(next) + 0.5) * segmentMm * ray.texDirection;
            next = min(next + emptySamples(ahead, segmentMm), count - 1);
            //@end
            float from = float(next) * segmentMm;
            float lengthMm = max(min(segmentMm, extent - from), 0.0);
            middle = from + 0.5 * lengthMm;
            vec3 p = start + middle * ray.texDirection;
            optical = sampleOptics(reconstruct(p), p, lengthMm);
            ++next;
        }
        if (composeOptics(optical, start + middle * ray.texDirection, tEnter + middle)) break;
    }
}
//@end

vec4 composeEnd() {
    return accumulated();
}
