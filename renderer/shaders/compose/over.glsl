// Emission-absorption front to back (Max 1995; Engel et al. 2006, equation 1.14), kept as optical depth: T = exp(-tau), and
// the weight of a segment is T before minus T after. The weights telescope, so they add up to 1 - T to float rounding
// however many segments a ray has and however thin or dense they are.
float opticalDepth;
float transmittance;
vec3 radiance;

void composeBegin() {
    opticalDepth = 0.0;
    transmittance = 1.0;
    radiance = vec3(0.0);
}

bool composeSample(float u, vec3 p, float t, float lengthMm) {
    vec4 optical = classify(u);
    //@when shade
    if (optical.a > 0.0)
        optical.rgb = shade(optical.rgb, gradientMm(p), ray.origin + t * ray.direction, -ray.direction);
    //@end
    opticalDepth += optical.a * lengthMm;
    float after = exp(-opticalDepth);
    radiance += (transmittance - after) * optical.rgb;
    transmittance = after;
    //@when terminate
    if (rayIsDone(transmittance)) return true;
    //@end
    return false;
}

vec4 composeEnd() {
    return vec4(radiance, 1.0 - transmittance);
}
