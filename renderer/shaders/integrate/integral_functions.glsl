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

// Mean of kappa c and kappa (per mm) over the values from one to the other.
vec4 meanOptics(float uFrom, float uTo) {
    float last = float(textureSize(integralTable, 0) - 1);
    vec2 position = vec2(uFrom, uTo) * integralFromValue.x + integralFromValue.y;
    vec4 a = classify(uFrom);
    vec4 b = classify(uTo);
    a.rgb *= a.a;
    b.rgb *= b.a;
    // Outside the table the function is constant: its value times the way outside belongs to the integral.
    vec2 inside = clamp(position, 0.0, last);
    vec2 outside = position - inside;
    vec4 integral = extinctionPerMm * (integralAt(inside.y) - integralAt(inside.x)) + outside.y * b - outside.x * a;
    float apart = position.y - position.x;
    vec4 mean = abs(apart) > 0.5 ? integral / apart : 0.5 * (a + b);
    return max(mean, 0.0);
}

vec4 integrateSegment(float uFront, float uBack, vec3 front, vec3 back, float lengthMm) {
    vec4 mean = meanOptics(uFront, uBack);
    vec3 color = mean.a > 0.0 ? min(mean.rgb / mean.a, 1.0) : classify(uFront).rgb;
    return vec4(color, mean.a * lengthMm);
}
