// Segments as long as the data around allow (Engel et al. 2006, section 7.3.3; equation 22 of docs/equations.md): along a segment the value
// deviates from the line between its ends, which is all that a pre-integrated segment sees, by no more than the tolerance.
uniform float stepMm;               // shortest
uniform float longestStepMm;
uniform sampler3D importanceVolume; // of the blocks around: bend per square of a voxel layer's thickness, bend at voxel planes
uniform vec3 importanceFromTexture; // blocks
uniform float layerMm;              // thickness of the thinnest layer of voxels
uniform float eightTolerances;      // part of the data's range
uniform float kinkWeight;           // 0 where the field has no kinks

float stepAt(vec3 p) {
    ivec3 last = textureSize(importanceVolume, 0) - 1;
    vec2 bend = texelFetch(importanceVolume, clamp(ivec3(p * importanceFromTexture), ivec3(0), last), 0).rg;
    float lengthMm = layerMm * sqrt(max(eightTolerances - kinkWeight * bend.y, 0.0) / max(bend.x, 1e-30));
    return clamp(lengthMm, stepMm, longestStepMm);
}

void traverse(float tEnter, float tExit) {
    vec3 start = ray.texOrigin + tEnter * ray.texDirection;
    float extent = tExit - tEnter;
    vec3 front = start;
    float uFront = reconstruct(front);
    float at = 0.0;
    float share = 1.0;
    //@when jitter
    share = rayOffset();
    //@end
    while (at < extent) {
        float lengthMm = stepAt(front) * share;
        share = 1.0;
        // A remainder shorter than float resolution of the ray is taken along.
        bool last = at + lengthMm >= extent * (1.0 - 1e-6);
        lengthMm = last ? extent - at : lengthMm;
        vec3 back = start + (at + lengthMm) * ray.texDirection;
        float uBack = reconstruct(back);
        if (composeSegment(segmentOptics(uFront, uBack, front, back, tEnter + at + 0.5 * lengthMm, lengthMm))) break;
        at = last ? extent : at + lengthMm;
        front = back;
        uFront = uBack;
    }
}
