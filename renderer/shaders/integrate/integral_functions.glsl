// Pre-integration from running integrals of the transfer function (Engel et al. 2006, equations 4.6 to 4.15; equation 13 of
// docs/equations.md): differences of integral tau and integral tau c between the end values. Colour is their quotient, so a constant
// colour stays itself; self-attenuation within the segment is neglected. Where the ends nearly agree the quotient would cancel,
// and the function itself is taken.
uniform sampler1D integralTable;   // running integral of tau c and of tau over the table coordinate, in entries
uniform vec2 integralFromValue;    // position in entries = u * x + y

// Between entries tau is linear, so its integral is a parabola; the neighbours' differences give it to second order.
vec4 integralAt(float position) {
    float last = float(textureSize(integralTable, 0) - 1);
    float i = clamp(floor(position), 0.0, last - 1.0);
    vec4 lower = texelFetch(integralTable, int(i), 0);
    vec4 upper = texelFetch(integralTable, int(i) + 1, 0);
    return mix(lower, upper, clamp(position - i, 0.0, 1.0));
}

vec4 integrateSegment(float uFront, float uBack, vec3 front, vec3 back, float lengthMm) {
    float last = float(textureSize(integralTable, 0) - 1);
    vec2 position = vec2(uFront, uBack) * integralFromValue.x + integralFromValue.y;
    vec4 a = classify(uFront);
    vec4 b = classify(uBack);
    float apart = position.y - position.x;
    // Outside the table the function is constant: its value times the way outside belongs to the integral.
    vec2 inside = clamp(position, 0.0, last);
    vec4 integral = integralAt(inside.y) - integralAt(inside.x);
    vec2 outside = position - inside;
    vec4 frontOptical = vec4(a.rgb * a.a, a.a) / extinctionPerMm;
    vec4 backOptical = vec4(b.rgb * b.a, b.a) / extinctionPerMm;
    integral += outside.y * backOptical - outside.x * frontOptical;
    vec4 ends = 0.5 * (frontOptical + backOptical);
    vec4 mean = abs(apart) > 0.5 ? integral / apart : ends;
    mean.a = max(mean.a, 0.0);
    vec3 color = mean.a > 0.0 ? clamp(mean.rgb / mean.a, 0.0, 1.0) : a.rgb;
    return vec4(color, mean.a * extinctionPerMm * lengthMm);
}
