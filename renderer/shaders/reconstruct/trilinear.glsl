// Linear interpolation along each axis by the texture unit.
uniform sampler3D volumeTexture;

float reconstruct(vec3 p) {
    return textureLod(volumeTexture, p, 0.0).r;
}
