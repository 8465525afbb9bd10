// Opaque surface where the value first reaches the isovalue; a ray that starts inside hits at once.
// The sample interval that holds the surface is remembered, and the root refined after the loop: once a ray.
uniform float isovalue;   // normalised value

float tInFront;  // last sample in front of the surface
float tBehind;   // first sample on it or behind it
bool started;
bool hit;

// Negative in front of the surface.
float surfaceFunction(float u) {
    return u - isovalue;
}

void composeBegin() {
    started = false;
    hit = false;
}

bool composeSample(float u, vec3 p, float t, float lengthMm) {
    hit = surfaceFunction(u) >= 0.0;
    tBehind = t;
    if (!hit || !started) tInFront = t;
    started = true;
    return hit;
}

vec4 composeEnd() {
    if (!hit) return vec4(0.0);
    // 20 halvings: a millionth of the step, below the float resolution of t.
    for (int i = 0; i < 20; ++i) {
        float middle = 0.5 * (tInFront + tBehind);
        bool behind = surfaceFunction(reconstruct(ray.texOrigin + middle * ray.texDirection)) >= 0.0;
        tBehind = behind ? middle : tBehind;
        tInFront = behind ? tInFront : middle;
    }
    vec3 p = ray.texOrigin + tBehind * ray.texDirection;
    vec3 color = classify(isovalue).rgb;
    //@when shade
    color = shade(color, gradientMm(p), ray.origin + tBehind * ray.direction, -ray.direction);
    //@end
    return vec4(color, 1.0);
}
