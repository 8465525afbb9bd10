// Minimum intensity projection of the value, then the window.
float least;

void composeBegin() {
    least = 3e38;
}

bool composeSample(float u, vec3 p, float t, float lengthMm) {
    least = min(least, u);
    return false;
}

vec4 composeEnd() {
    return inVolume ? vec4(classify(least).rgb, 1.0) : vec4(0.0);
}
