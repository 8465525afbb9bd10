// Simpson's rule over a segment (equation 10 of docs/equations.md). The emission is attenuated by the depth up to the middle, from the
// parabola through the three extinctions. Fourth order where everything is smooth; weights are never negative.
vec4 integrateSegment(float uFront, float uBack, vec3 front, vec3 back, float lengthMm) {
    vec4 a = classify(uFront);
    vec4 m = classify(reconstruct(0.5 * (front + back)));
    vec4 b = classify(uBack);
    float depth = lengthMm / 6.0 * (a.a + 4.0 * m.a + b.a);
    float toMiddle = max(lengthMm / 24.0 * (5.0 * a.a + 8.0 * m.a - b.a), 0.0);
    vec3 weight = vec3(a.a, 4.0 * m.a * exp(-min(toMiddle, depth)), b.a * exp(-depth));
    float sum = weight.x + weight.y + weight.z;
    vec3 color = sum > 0.0 ? (weight.x * a.rgb + weight.y * m.rgb + weight.z * b.rgb) / sum : m.rgb;
    return vec4(color, depth);
}
