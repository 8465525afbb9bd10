// Minimum intensity projection of the value, then the window.
float least;
bool seen;

void composeBegin() {
    least = 3e38;
    seen = false;
}

bool composeSample(float u, vec3 p, float t, float lengthMm) {
    least = min(least, u);
    seen = true;
    return false;
}

vec4 composeEnd() {
    return seen ? vec4(classify(least).rgb, 1.0) : vec4(0.0);
}
