// Ray starts shifted by a part of a step (Engel et al. 2006, section 9.1.4; equation 14 of docs/equations.md): rings become noise without low frequencies. The first
// segment is shortened like the last, so nothing is left out at either end of the ray.
uniform sampler2D blueNoise;   // 64 x 64, each of 4096 ranks once

float rayOffset() {
    ivec2 pixelPlace = ivec2(floor(picturePlace())) & 63;
    return texelFetch(blueNoise, pixelPlace, 0).r;
}
