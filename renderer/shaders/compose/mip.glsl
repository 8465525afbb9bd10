// Maximum intensity projection of the value (Engel et al. 2006, equation 1.16), then the window.
float greatest;

void composeBegin() {
    greatest = -3e38;
}

bool composeSample(float u, vec3 p, float t, float lengthMm) {
    greatest = max(greatest, u);
    return false;
}

vec4 composeEnd() {
    return inVolume ? vec4(classify(greatest).rgb, 1.0) : vec4(0.0);
}
