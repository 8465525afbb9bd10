// Emission only: a transparent glow, the integral of extinction * colour, added to the background.
vec3 radiance;

void composeBegin() {
    radiance = vec3(0.0);
}

bool composeSample(float u, vec3 p, float t, float lengthMm) {
    vec4 optical = classifySample(u, p);
    radiance += optical.a * lengthMm * optical.rgb;
    return false;
}

vec4 composeEnd() {
    return vec4(radiance, 0.0);
}
