// Blinn-Phong reflection (Blinn 1977; Engel et al. 2006, section 5.4; equation 16 of docs/equations.md), two-sided.
struct LightData {
    vec4 color;     // RGB * intensity
    vec4 place;     // w = 0: unit vector towards the light; w = 1: position, render coordinates
};
layout(std140, binding = 0) uniform Lights {
    LightData lights[lightCount];
};
uniform vec4 material;  // ambient, diffuse, specular, shininess

vec3 shade(vec3 color, vec3 gradient, vec3 position, vec3 toViewer) {
    float steepness = dot(gradient, gradient);
    vec3 n = gradient * inversesqrt(max(steepness, 1e-37));
    n = dot(n, toViewer) < 0.0 ? -n : n;
    vec3 shown = material.x * color;
    for (int i = 0; i < lightCount; ++i) {
        vec3 l = lights[i].place.w == 0.0 ? lights[i].place.xyz : normalize(lights[i].place.xyz - position);
        vec3 halfway = l + toViewer;
        float h = max(dot(n, halfway), 0.0) * inversesqrt(max(dot(halfway, halfway), 1e-12));
        float highlight = h > 0.0 ? pow(h, material.w) : 0.0;
        shown += lights[i].color.rgb * (material.y * max(dot(n, l), 0.0) * color + material.z * highlight);
    }
    return steepness > 0.0 ? shown : color;
}
