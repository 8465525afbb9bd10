// Pre-integrated segment (Engel et al. 2006, sections 4.5 and 4.6; equation 12 of docs/equations.md). The table holds segments between values within
// it. Beyond it the function is constant, so a segment that leaves the table has up to three parts, each integrated exactly.
uniform vec2 entryFromValue;   // position in entries = u * x + y
uniform vec4 opticsBelow;      // colour and extinction per unit length of all values below the table
uniform vec4 opticsAbove;      // and above it

vec4 integrateSegment(float uFront, float uBack, vec3 front, vec3 back, float lengthMm) {
    vec2 position = vec2(uFront, uBack) * entryFromValue.x + entryFromValue.y;
    vec2 inside = clamp(position, 0.0, float(textureSize(preintegrationTable, 0).x - 1));
    float apart = abs(position.y - position.x);
    float within = abs(inside.y - inside.x);
    // Both ends on the same side, or the same value: the table says what is there.
    vec3 parts = within > 0.0 ? vec3(abs(inside.x - position.x), within, abs(position.y - inside.y)) / apart : vec3(0.0, 1.0, 0.0);
    vec4 optics = tabulatedSegment(inside, parts.y * lengthMm);   // of the part within: extinction times colour, extinction
    vec4 before = position.x < 0.0 ? opticsBelow : opticsAbove;
    vec4 behind = position.y < 0.0 ? opticsBelow : opticsAbove;
    vec3 depth = extinctionPerMm * lengthMm * parts * vec3(before.a, optics.a, behind.a);
    vec3 upTo = vec3(depth.x, depth.x + depth.y, depth.x + depth.y + depth.z);
    // What is seen of each part; of a thin segment, all of it.
    vec3 through = exp(-upTo);
    vec3 weight = upTo.z < 1e-3 ? depth : vec3(1.0, through.xy) - through;
    vec3 colorWithin = optics.a > 0.0 ? optics.rgb / optics.a : vec3(0.0);
    vec3 seen = weight.x * before.rgb + weight.y * colorWithin + weight.z * behind.rgb;
    return vec4(seen / max(weight.x + weight.y + weight.z, 1e-37), upTo.z);
}
