// Post-classification: the reconstructed value looks up colour and extinction.
uniform sampler1D transferTable;   // RGB in the compositing space, extinction per unit length
uniform vec2 tableFromValue;       // table coordinate = u * x + y
uniform float extinctionPerMm;     // density scale / unit length

vec4 classify(float u) {
    vec4 entry = textureLod(transferTable, u * tableFromValue.x + tableFromValue.y, 0.0);
    return vec4(entry.rgb, entry.a * extinctionPerMm);
}

vec4 classifySample(float u, vec3 p) {
    return classify(u);
}
