// Pre-integrated segment of one length (Engel et al. 2006, sections 4.5 and 4.6; equation 12 of docs/equations.md): the table holds mean extinction and
// the colour seen through the segment itself. The depth scales exactly with the length of a shortened last segment.
uniform sampler2D preintegrationTable;   // colour, mean extinction per unit length; x: front value, y: back value
uniform vec2 preintegrationFromValue;    // table coordinate = u * x + y
uniform float extinctionPerMm;

vec4 integrateSegment(float uFront, float uBack, vec3 front, vec3 back, float lengthMm) {
    vec2 place = vec2(uFront, uBack) * preintegrationFromValue.x + preintegrationFromValue.y;
    vec4 entry = textureLod(preintegrationTable, place, 0.0);
    return vec4(entry.rgb, entry.a * extinctionPerMm * lengthMm);
}
