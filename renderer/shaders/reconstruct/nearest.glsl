// The voxel whose cell holds p: the texture's sampler does not interpolate.
uniform sampler3D volumeTexture;

float reconstruct(vec3 p) {
    return textureLod(volumeTexture, p, 0.0).r;
}
