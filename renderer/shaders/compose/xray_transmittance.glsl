// Absorption only (Engel et al. 2006, section 1.2; Van Gelder and Kim 1996, section 3.3): light of intensity 1 behind
// the volume, dimmed to exp(-tau). The optical depth is summed and exponentiated once, so the order does not matter.
float opticalDepth;

void composeBegin() {
    opticalDepth = 0.0;
}

bool composeSample(float u, vec3 p, float t, float lengthMm) {
    opticalDepth += classifySample(u, p).a * lengthMm;
    return false;
}

vec4 composeEnd() {
    return vec4(vec3(exp(-opticalDepth)), 1.0);
}
