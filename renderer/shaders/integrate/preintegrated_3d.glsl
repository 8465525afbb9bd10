// Pre-integrated segment of any length up to the step (equation 12 of docs/equations.md): layer k of the table is for length k / (layers - 1) * step.
uniform sampler3D preintegrationTable;   // colour, mean extinction per unit length; x: front value, y: back value, z: length
uniform vec2 preintegrationFromValue;    // table coordinate = u * x + y
uniform vec2 preintegrationFromLength;   // table coordinate = length in mm * x + y
uniform float extinctionPerMm;

vec4 integrateSegment(float uFront, float uBack, vec3 front, vec3 back, float lengthMm) {
    vec2 place = vec2(uFront, uBack) * preintegrationFromValue.x + preintegrationFromValue.y;
    float layer = lengthMm * preintegrationFromLength.x + preintegrationFromLength.y;
    vec4 entry = textureLod(preintegrationTable, vec3(place, layer), 0.0);
    return vec4(entry.rgb, entry.a * extinctionPerMm * lengthMm);
}
