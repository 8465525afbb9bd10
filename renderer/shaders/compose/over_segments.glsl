// Emission-absorption, segments integrated from both ends.
void composeBegin() {
    accumulateBegin();
}

// Colour of the segment and its optical depth. Light is reflected in its middle.
vec4 segmentOptics(float uFront, float uBack, vec3 front, vec3 back, float tMiddle, float lengthMm) {
    vec4 optical = integrateSegment(uFront, uBack, front, back, lengthMm);
    //@when shade
    if (optical.a > 0.0)
        optical.rgb = shade(optical.rgb, gradientMm(0.5 * (front + back)), ray.origin + tMiddle * ray.direction,
                            -ray.direction);
    //@end
    return optical;
}

bool composeSegment(vec4 optical) {
    accumulate(optical.rgb, optical.a);
    //@when terminate
    if (rayIsDone(transmittance)) return true;
    //@end
    return false;
}

vec4 composeEnd() {
    return accumulated();
}
