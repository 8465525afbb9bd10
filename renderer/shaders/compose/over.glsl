// Emission-absorption, one sample a segment.
void composeBegin() {
    accumulateBegin();
}

bool composeSample(float u, vec3 p, float t, float lengthMm) {
    vec4 optical = integrateSample(u, lengthMm);
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

vec4 composeEnd() {
    return accumulated();
}
