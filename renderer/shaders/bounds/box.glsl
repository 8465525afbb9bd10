// The box around all blocks in which something can show: samples outside it need not be taken. Steps are counted on the grid that
// the ray has without the box, so that the samples left are the same ones.
uniform vec3 boxLo;  // texture coordinates; above boxHi when nothing shows
uniform vec3 boxHi;

// First step and end of the steps (`end` not included) whose middle, or either end, may lie in the box; within 0 ... count.
ivec2 occupiedSteps(float tEnter, float lengthMm, int count) {
    vec3 speed = abs(ray.texDirection);
    bvec3 still = lessThanEqual(speed, vec3(1e-7 * max(speed.x, max(speed.y, speed.z))));
    vec3 distanceOut = max(boxLo - ray.texOrigin, ray.texOrigin - boxHi);
    bool misses = any(greaterThan(mix(vec3(-1.0), distanceOut, still), vec3(0.0))) || boxLo.x > boxHi.x;
    vec3 inverse = 1.0 / mix(ray.texDirection, vec3(1.0), still);
    vec3 a = (boxLo - ray.texOrigin) * inverse;
    vec3 b = (boxHi - ray.texOrigin) * inverse;
    vec3 lo = mix(min(a, b), vec3(-3e38), still);
    vec3 hi = mix(max(a, b), vec3(3e38), still);
    float from = (max(lo.x, max(lo.y, lo.z)) - tEnter) / lengthMm;
    float to = (min(hi.x, min(hi.y, hi.z)) - tEnter) / lengthMm;
    if (misses || from > to) return ivec2(0);
    float most = float(count);
    return ivec2(clamp(floor(from - 0.5), 0.0, most), clamp(ceil(to + 0.5), 0.0, most));
}
