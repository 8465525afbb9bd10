// Front-to-back blending as a target with 8-bit channels does it: opacities below 1/510 of what is still visible vanish
// (opacity 0.01 stalls near 0.81).
float transmittance;
vec4 shownSoFar;   // associated colour and opacity

vec4 rounded(vec4 v) {
    return round(clamp(v, 0.0, 1.0) * 255.0) / 255.0;
}

void accumulateBegin() {
    transmittance = 1.0;
    shownSoFar = vec4(0.0);
}

void accumulate(vec3 color, float depth) {
    float opacity = 1.0 - exp(-depth);
    shownSoFar = rounded(shownSoFar + (1.0 - shownSoFar.a) * opacity * vec4(color, 1.0));
    transmittance = 1.0 - shownSoFar.a;
}

vec4 accumulated() {
    return shownSoFar;
}
