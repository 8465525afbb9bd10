// The cubic B-spline with its four weights looked up in a table over [0, 1] (Engel et al. 2006, section 9.2.5): this text
// is the same for any kernel of four voxels. For comparison with weights evaluated in place.
uniform sampler3D volumeTexture;
uniform sampler1D filterWeights;  // w_-1 ... w_2 at u = n / (size - 1)

vec4 weightsAt(float u) {
    float size = float(textureSize(filterWeights, 0));
    // The table ends at u = 1 and does not repeat: w_i(1) is w_(i+1)(0), not w_i(0).
    return textureLod(filterWeights, (u * (size - 1.0) + 0.5) / size, 0.0);
}

float reconstruct(vec3 p) {
    ivec3 last = textureSize(volumeTexture, 0) - 1;
    vec3 position = p * vec3(last + 1) - 0.5;
    vec3 base = floor(position);
    vec4 x = weightsAt(position.x - base.x);
    vec4 y = weightsAt(position.y - base.y);
    vec4 z = weightsAt(position.z - base.z);
    ivec3 first = ivec3(base) - 1;
    float sum = 0.0;
    for (int k = 0; k < 4; ++k)
        for (int j = 0; j < 4; ++j) {
            vec4 row;
            for (int i = 0; i < 4; ++i)
                row[i] = texelFetch(volumeTexture, clamp(first + ivec3(i, j, k), ivec3(0), last), 0).r;
            sum += z[k] * y[j] * dot(x, row);
        }
    return sum;
}
