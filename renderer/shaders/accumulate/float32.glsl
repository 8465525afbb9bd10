// Front to back in 32-bit float (Max 1995; Engel et al. 2006, equation 1.14), kept as optical depth: T = exp(-tau), and the
// weight of a segment is T before minus T after. The weights telescope, so they add up to 1 - T to float rounding
// however many segments a ray has and however thin or dense they are (equation 6 of docs/equations.md).
float opticalDepth;
float transmittance;
vec3 radiance;

void accumulateBegin() {
    opticalDepth = 0.0;
    transmittance = 1.0;
    radiance = vec3(0.0);
}

void accumulate(vec3 color, float depth) {
    opticalDepth += depth;
    float after = exp(-opticalDepth);
    radiance += (transmittance - after) * color;
    transmittance = after;
}

vec4 accumulated() {
    return vec4(radiance, 1.0 - transmittance);
}
