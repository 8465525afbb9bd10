// Front-to-back blending as a target with 16-bit float channels does it: every sum is rounded, and faint opacities are lost
// once the sum is large (opacity 0.001 stalls near 0.76).
float transmittance;
vec4 shownSoFar;   // associated colour and opacity

vec4 rounded(vec4 v) {
    return vec4(unpackHalf2x16(packHalf2x16(v.xy)), unpackHalf2x16(packHalf2x16(v.zw)));
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
