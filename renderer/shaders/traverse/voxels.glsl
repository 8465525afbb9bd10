// Segments from voxel border to voxel border, for a field that is constant in each voxel: exact whatever the transfer function. Steps
// that are chosen by differences between samples would pass over voxels of any value unseen.

void traverse(float tEnter, float tExit) {
    vec3 voxels = vec3(textureSize(volumeTexture, 0));
    vec3 speed = voxels * ray.texDirection;
    float fastest = max(abs(speed.x), max(abs(speed.y), abs(speed.z)));
    bvec3 still = lessThanEqual(abs(speed), vec3(1e-7 * fastest));
    vec3 advance = 1.0 / mix(abs(speed), vec3(1.0), still);
    vec3 place = voxels * (ray.texOrigin + tEnter * ray.texDirection);
    // To the first border along each axis, voxels; later ones are counted from it, so no rounding adds up.
    vec3 toBorder = mix(fract(place), 1.0 - fract(place), greaterThan(speed, vec3(0.0)));
    vec3 crossed = vec3(0.0);
    float extent = tExit - tEnter;
    float at = 0.0;
    while (at < extent) {
        vec3 next = mix((toBorder + crossed) * advance, vec3(3e38), still);
        float nearest = min(next.x, min(next.y, next.z));
        float to = min(nearest, extent);
        float middle = 0.5 * (at + to);
        vec3 p = ray.texOrigin + (tEnter + middle) * ray.texDirection;
        float u = reconstruct(p);
        if (composeSegment(segmentOptics(u, u, p, p, tEnter + middle, to - at))) break;
        crossed += mix(vec3(0.0), vec3(1.0), lessThanEqual(next, vec3(nearest)));
        at = to;
    }
}
