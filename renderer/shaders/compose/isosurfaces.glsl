// Several surfaces of equal value, each seen through those in front of it (Engel et al. 2006, section 4.8; equation 23 of docs/equations.md).
// A value's level is the number of isovalues it reaches; between two samples every level that changes is one crossing, in the order in
// which the value passes them. A value on an isovalue has reached it, so neighbouring segments never count a crossing twice or lose one.
struct SurfaceData {
    vec4 color;   // compositing space; opacity
    vec4 value;   // normalised, ascending
};
layout(std140, binding = 1) uniform Surfaces {
    SurfaceData surfaces[surfaceCount];
};

float transmittance;
vec3 radiance;

void composeBegin() {
    transmittance = 1.0;
    radiance = vec3(0.0);
}

int levelOf(float u) {
    int level = 0;
    for (int i = 0; i < surfaceCount; ++i) level += u >= surfaces[i].value.x ? 1 : 0;
    return level;
}

// The crossing of surface k between two samples on either side of it.
bool composeCrossing(int k, float tFront, float uFront, float tBack, float uBack) {
    float sought = surfaces[k].value.x;
    bool rising = uBack > uFront;
    // Halved to 1/256 of the step, then a line: exact to float where the value is smooth.
    for (int i = 0; i < 8; ++i) {
        float middle = 0.5 * (tFront + tBack);
        float u = reconstruct(ray.texOrigin + middle * ray.texDirection);
        bool behind = (u >= sought) == rising;
        tFront = behind ? tFront : middle;
        uFront = behind ? uFront : u;
        tBack = behind ? middle : tBack;
        uBack = behind ? u : uBack;
    }
    float t = mix(tFront, tBack, clamp((sought - uFront) / (uBack - uFront), 0.0, 1.0));
    vec3 p = ray.texOrigin + t * ray.texDirection;
    vec3 color = surfaces[k].color.rgb;
    //@when shade
    color = shade(color, gradientMm(p), ray.origin + t * ray.direction, -ray.direction);
    //@end
    radiance += transmittance * surfaces[k].color.a * color;
    transmittance *= 1.0 - surfaces[k].color.a;
    return transmittance <= 0.0;
}

vec4 composeEnd() {
    return vec4(radiance, 1.0 - transmittance);
}
