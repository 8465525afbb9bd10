// Central differences of the voxels, made once and interpolated: of a trilinear field they are those of the field itself over one voxel to
// each side (equation 25 of docs/equations.md), for one fetch in place of six. The value stands beside them.
uniform sampler3D fieldTexture;      // differences along the index axes, value; one voxel more on every side
uniform vec3 fieldScale;             // coordinates in fieldTexture = texture coordinates * scale + offset
uniform vec3 fieldOffset;
uniform vec2 differenceFromTexel;    // per voxel = (texel - y) * x
uniform mat3 gradientFromIndex;      // transpose(inverse(renderFromIndex)), scaled to largest entry 1: only its direction counts
uniform float gradientFloor;         // per voxel; smaller gradients are rounding noise

vec4 fieldAt(vec3 p) {
    return textureLod(fieldTexture, p * fieldScale + fieldOffset, 0.0);
}

vec3 gradientOf(vec4 field) {
    vec3 perIndex = (field.rgb - differenceFromTexel.y) * differenceFromTexel.x;
    return dot(perIndex, perIndex) > gradientFloor * gradientFloor ? gradientFromIndex * perIndex : vec3(0.0);
}

vec3 gradientMm(vec3 p) {
    return gradientOf(fieldAt(p));
}
