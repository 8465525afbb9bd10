// Emission-absorption, one sample a segment, lit by the gradient that is fetched with its value. Transparent samples are lit like the
// others, which takes less than to look for visible ones (compare composeLit in compose/over.glsl) and adds nothing.
void composeBegin() {
    accumulateBegin();
}

bool composeField(vec4 field, vec3 p, float t, float lengthMm) {
    vec4 optical = integrateSample(field.a, p, lengthMm);
    optical.rgb = shade(optical.rgb, gradientOf(field), ray.origin + t * ray.direction, -ray.direction);
    accumulate(optical.rgb, optical.a);
    //@when terminate
    if (rayIsDone(transmittance)) return true;
    //@end
    return false;
}

vec4 composeEnd() {
    return accumulated();
}
