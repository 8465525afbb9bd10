// Constant segment, integrated exactly (equation 6 of docs/equations.md): colour as it is, optical depth kappa d. Second order.
vec4 integrateSample(float u, float lengthMm) {
    vec4 optical = classify(u);
    return vec4(optical.rgb, optical.a * lengthMm);
}
