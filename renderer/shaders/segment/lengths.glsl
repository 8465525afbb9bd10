// Length is an axis of the table: layer k is for (k / (layers - 1))^2 of the full length.
uniform sampler3D preintegrationTable;   // extinction times colour, extinction per unit length; x: front entry, y: back entry, z: length
uniform float fullLengthMm;
uniform float extinctionPerMm;

vec4 tabulatedSegment(vec2 entry, float lengthMm) {
    vec3 size = vec3(textureSize(preintegrationTable, 0));
    float layer = sqrt(lengthMm / fullLengthMm) * (size.z - 1.0);
    return textureLod(preintegrationTable, (vec3(entry, layer) + 0.5) / size, 0.0);
}
