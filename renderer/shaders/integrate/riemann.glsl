// The historical Riemann sum (Engel et al. 2006, equations 1.12 and 1.13; equation 8 of docs/equations.md): the segment emits
// kappa c d as if it did not absorb its own light. First order, and too bright by x / (1 - exp(-x)), x = kappa d.
vec4 integrateSample(float u, vec3 p, float lengthMm) {
    vec4 optical = classifySample(u, p);
    float x = optical.a * lengthMm;
    float excess = x > 1e-3 ? x / (1.0 - exp(-x)) : 1.0 + 0.5 * x;
    return vec4(optical.rgb * excess, x);
}
