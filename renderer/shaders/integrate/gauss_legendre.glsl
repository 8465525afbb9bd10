// Two-point Gauss-Legendre quadrature over a segment (equation 11 of docs/equations.md): inner points at (1 -+ 1/sqrt(3)) / 2, the depth
// up to each from the line through both extinctions. Fourth order where everything is smooth; weights are never negative.
vec4 integrateSegment(float uFront, float uBack, vec3 front, vec3 back, float lengthMm) {
    const float first = 0.2113248654;
    vec4 a = classify(reconstruct(mix(front, back, first)));
    vec4 b = classify(reconstruct(mix(front, back, 1.0 - first)));
    float depth = 0.5 * lengthMm * (a.a + b.a);
    // 1/4 and 1/4 -+ sqrt(3)/6: the coefficients of the two-stage Gauss method.
    float toA = max(lengthMm * (0.25 * a.a - 0.0386751346 * b.a), 0.0);
    float toB = lengthMm * (0.5386751346 * a.a + 0.25 * b.a);
    vec2 weight = vec2(a.a * exp(-min(toA, depth)), b.a * exp(-min(toB, depth)));
    float sum = weight.x + weight.y;
    vec3 color = sum > 0.0 ? (weight.x * a.rgb + weight.y * b.rgb) / sum : 0.5 * (a.rgb + b.rgb);
    return vec4(color, depth);
}
