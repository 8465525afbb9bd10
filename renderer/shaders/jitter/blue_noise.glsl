// Ray starts shifted by a part of a step (Engel et al. 2006, section 9.1.4; equation 14 of docs/equations.md): rings become noise without low frequencies. The first
// segment is shortened like the last, so nothing is left out at either end of the ray.
uniform sampler2D blueNoise;   // 64 x 64, each of 4096 ranks once

float rayShift() {
    ivec2 pixelPlace = ivec2(floor(picturePlace())) & 63;
    return texelFetch(blueNoise, pixelPlace, 0).r;
}

float rayOffset() {
    //@when slab
    // A part behind the first begins where the one in front of it ends, a whole step after the last.
    if (slabFromMm > 0.0) return 0.0;
    //@end
    return rayShift();
}
