// Minimum intensity projection of the value, then the window.
float extreme;
float extremeAt;  // where on the ray it was found

void composeBegin() {
    extreme = 3e38;
}

bool composeSample(float u, vec3 p, float t, float lengthMm) {
    extremeAt = u < extreme ? t : extremeAt;
    extreme = min(extreme, u);
    return false;
}

vec4 composeEnd() {
    return inVolume ? vec4(classify(extreme).rgb, 1.0) : vec4(0.0);
}
