// Trapezoidal rule over a segment (equation 9 of docs/equations.md): mean extinction of the ends, colours weighted with it.
// Second order; the weights are never negative, so a constant colour stays itself in any medium.
vec4 integrateSegment(float uFront, float uBack, vec3 front, vec3 back, float lengthMm) {
    vec4 a = classify(uFront);
    vec4 b = classify(uBack);
    float sum = a.a + b.a;
    vec3 color = sum > 0.0 ? (a.a * a.rgb + b.a * b.rgb) / sum : 0.5 * (a.rgb + b.rgb);
    return vec4(color, 0.5 * sum * lengthMm);
}
