// Mean of the value over the path inside the volume (weights: segment length / path length), then the window.
float weightedSum;
float path;

void composeBegin() {
    weightedSum = 0.0;
    path = 0.0;
}

bool composeSample(float u, vec3 p, float t, float lengthMm) {
    weightedSum += u * lengthMm;
    path += lengthMm;
    return false;
}

vec4 composeEnd() {
    return path > 0.0 ? vec4(classify(weightedSum / path).rgb, 1.0) : vec4(0.0);
}
