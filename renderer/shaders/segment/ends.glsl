// Two tables: for segments so short that nothing hides anything, and for the full length. In between, colours go from the one to the other as far
// as light's mean place of origin goes to the front, which is exact where extinction is constant and colour linear.
uniform sampler2DArray preintegrationTable;   // extinction times colour, extinction per unit length; x: front entry, y: back entry
uniform float fullLengthMm;
uniform float extinctionPerMm;

// 1/2 - the mean place of origin, as a part of a segment of that optical depth: 1/2 - 1 / d + 1 / (exp(d) - 1). The series is exact to 1e-4 below 0.5
// and avoids the cancellation.
float towardsFront(float depth) {
    float through = exp(-depth);
    return depth < 0.5 ? depth * (1.0 / 12.0 - depth * depth / 720.0) : 0.5 - 1.0 / depth + through / (1.0 - through);
}

vec4 tabulatedSegment(vec2 entry, float lengthMm) {
    vec2 place = (entry + 0.5) / float(textureSize(preintegrationTable, 0).x);
    vec4 thin = textureLod(preintegrationTable, vec3(place, 0.0), 0.0);
    vec4 full = textureLod(preintegrationTable, vec3(place, 1.0), 0.0);
    float perMm = thin.a * extinctionPerMm;
    float fullDepth = perMm * fullLengthMm;
    float toFull = fullDepth > 1e-6 ? towardsFront(perMm * lengthMm) / towardsFront(fullDepth) : 1.0;
    return mix(thin, full, min(toFull, 1.0));
}
