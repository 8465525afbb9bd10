// Maximum intensity projection of the value (Engel et al. 2006, equation 1.16), then the window.
float greatest;
bool seen;

void composeBegin() {
    greatest = -3e38;
    seen = false;
}

bool composeSample(float u, vec3 p, float t, float lengthMm) {
    greatest = max(greatest, u);
    seen = true;
    return false;
}

vec4 composeEnd() {
    return seen ? vec4(classify(greatest).rgb, 1.0) : vec4(0.0);
}
