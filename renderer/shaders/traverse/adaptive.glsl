// Steps that keep the error of a ray below `tolerance` (equation 15 of docs/equations.md). A segment is integrated whole and in two halves;
// the difference, as it would show, is its error estimate and must stay below its share of the tolerance. The halves are composed.
// With pre-integrated segments the error is of third order in the length, which sets the next step.
uniform float stepMm;          // longest step
uniform float shortestStepMm;
uniform float tolerance;       // of a whole ray, display units
uniform int mostSegments;

void traverse(float tEnter, float tExit) {
    vec3 start = ray.texOrigin + tEnter * ray.texDirection;
    float extent = tExit - tEnter;
    float at = 0.0;
    float lengthMm = stepMm;
    vec3 front = start;
    float uFront = reconstruct(front);
    float visible = 1.0;
    for (int i = 0; i < mostSegments && at < extent; ++i) {
        // A remainder shorter than float resolution of the ray is taken along.
        bool last = at + lengthMm >= extent * (1.0 - 1e-6);
        lengthMm = last ? extent - at : lengthMm;
        vec3 middle = start + (at + 0.5 * lengthMm) * ray.texDirection;
        vec3 back = start + (at + lengthMm) * ray.texDirection;
        float uMiddle = reconstruct(middle);
        float uBack = reconstruct(back);
        float t = tEnter + at;
        vec4 whole = segmentOptics(uFront, uBack, front, back, t + 0.5 * lengthMm, lengthMm);
        vec4 a = segmentOptics(uFront, uMiddle, front, middle, t + 0.25 * lengthMm, 0.5 * lengthMm);
        vec4 b = segmentOptics(uMiddle, uBack, middle, back, t + 0.75 * lengthMm, 0.5 * lengthMm);
        float throughA = exp(-a.a);
        float throughBoth = exp(-a.a - b.a);
        vec3 once = (1.0 - exp(-whole.a)) * whole.rgb;
        vec3 twice = (1.0 - throughA) * a.rgb + (throughA - throughBoth) * b.rgb;
        vec3 apart = abs(once - twice);
        // Between the samples the field may leave the values seen, by about its deviation from a line; what the function does there must
        // not matter either, or a thin peak just out of reach would go unseen.
        float lowest = min(uFront, min(uMiddle, uBack));
        float highest = max(uFront, max(uMiddle, uBack));
        float beyond = 4.0 * abs(uMiddle - 0.5 * (uFront + uBack));
        vec4 unseen = max(abs(meanOptics(lowest - beyond, lowest) - meanOptics(lowest, lowest)),
                          abs(meanOptics(highest, highest + beyond) - meanOptics(highest, highest)));
        float missed = lengthMm * max(max(unseen.r, unseen.g), max(unseen.b, unseen.a));
        float seen = max(max(apart.r, max(apart.g, apart.b)), abs(exp(-whole.a) - throughBoth));
        float error = visible * max(seen, min(missed, 1.0));
        float allowed = tolerance * lengthMm / extent;
        if (error <= allowed || lengthMm <= shortestStepMm) {
            if (composeSegment(a)) return;
            if (composeSegment(b)) return;
            visible *= throughBoth;
            at = last ? extent : at + lengthMm;
            front = back;
            uFront = uBack;
        }
        float change = 0.9 * pow(allowed / max(error, 1e-12), 1.0 / 3.0);
        lengthMm = clamp(lengthMm * clamp(change, 0.2, 3.0), shortestStepMm, stepMm);
    }
    // Turns used up: the rest is one segment rather than nothing.
    if (at < extent) {
        vec3 back = start + extent * ray.texDirection;
        composeSegment(segmentOptics(uFront, reconstruct(back), front, back, tEnter + 0.5 * (at + extent), extent - at));
    }
}
