// Emission-absorption, one sample a segment.
void composeBegin() {
    accumulateBegin();
}

// Colour of a sample that is not lit yet, and its optical depth.
vec4 sampleOptics(float u, float lengthMm) {
    return integrateSample(u, lengthMm);
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
    return composeOptics(sampleOptics(u, lengthMm), p, t);
}

vec4 composeEnd() {
    return accumulated();
}
