// The one sample of a slice, through the window.
float value;
bool seen;

void composeBegin() {
    seen = false;
}

bool composeSample(float u, vec3 p, float t, float lengthMm) {
    value = u;
    seen = true;
    return true;
}

vec4 composeEnd() {
    return seen ? vec4(classify(value).rgb, 1.0) : vec4(0.0);
}
