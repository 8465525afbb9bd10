// Central differences of the reconstructed field over one voxel to each side, on the fly (second order).
// Differences along the index axes become a gradient in mm by the transposed inverse, so that shear and anisotropy are right.
uniform vec3 voxelStep;            // 1 / size, texture coordinates
uniform mat3 gradientFromIndex;    // transpose(inverse(renderFromIndex)), scaled to largest entry 1: only its direction counts
uniform float gradientFloor;       // per voxel; smaller gradients are rounding noise

vec3 gradientMm(vec3 p) {
    vec3 dx = vec3(voxelStep.x, 0.0, 0.0);
    vec3 dy = vec3(0.0, voxelStep.y, 0.0);
    vec3 dz = vec3(0.0, 0.0, voxelStep.z);
    vec3 perIndex = 0.5 * vec3(reconstruct(p + dx) - reconstruct(p - dx),
                               reconstruct(p + dy) - reconstruct(p - dy),
                               reconstruct(p + dz) - reconstruct(p - dz));
    return dot(perIndex, perIndex) > gradientFloor * gradientFloor ? gradientFromIndex * perIndex : vec3(0.0);
}
