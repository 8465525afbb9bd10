// Window and level: black at level - width / 2, white at level + width / 2.
uniform vec2 windowFromValue;   // grey = u * x + y

vec4 classify(float u) {
    return vec4(vec3(clamp(u * windowFromValue.x + windowFromValue.y, 0.0, 1.0)), 1.0);
}
