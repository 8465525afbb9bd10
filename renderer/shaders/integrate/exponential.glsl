// Constant segment, integrated exactly (equation 6 of docs/equations.md): colour as it is, optical depth kappa d. Second order.
vec4 integrateSample(float u, vec3 p, float lengthMm) {
    vec4 optical = classifySample(u, p);
    return vec4(optical.rgb, optical.a * lengthMm);
}
