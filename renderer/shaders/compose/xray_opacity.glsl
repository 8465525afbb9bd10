// Absorption only, shown as opacity 1 - exp(-tau): dense matter is bright.
float opticalDepth;

void composeBegin() {
    opticalDepth = 0.0;
}

bool composeSample(float u, vec3 p, float t, float lengthMm) {
    opticalDepth += classifySample(u, p).a * lengthMm;
    return false;
}

vec4 composeEnd() {
    // 1 - exp(-tau) loses all digits for small tau; the series is exact to float below 0.01.
    float thin = opticalDepth * (1.0 - opticalDepth * (0.5 - opticalDepth * (1.0 / 6.0 - opticalDepth / 24.0)));
    return vec4(vec3(opticalDepth < 0.01 ? thin : 1.0 - exp(-opticalDepth)), 1.0);
}
