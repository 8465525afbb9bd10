// Leaps over empty blocks: the field holds for each block the distance (largest of the three axes, in blocks) to the nearest one in
// which something can show, so the cube of that radius around it is empty whichever way the ray goes. Blocks know their voxels with
// a margin of half a voxel more than interpolation needs: rounding of positions does not matter.
uniform usampler3D leapField;     // 0: something can show in the block
uniform vec3 blocksFromTexture;   // blocks (the last may be cut) = texture coordinates * this

vec3 leapSide;     // 1 along axes on which the ray ascends, else -1
vec3 leapMmABlock; // along each axis, with sign

void leapBegin() {
    vec3 speed = blocksFromTexture * ray.texDirection;
    leapSide = mix(vec3(-1.0), vec3(1.0), greaterThanEqual(speed, vec3(0.0)));
    float fastest = max(abs(speed.x), max(abs(speed.y), abs(speed.z)));
    leapMmABlock = leapSide / max(abs(speed), vec3(1e-7 * fastest));
}

// How far along the ray from p on nothing can show, in mm; 0 or less when p is in a block that shows.
float emptyMm(vec3 p) {
    vec3 place = p * blocksFromTexture;
    ivec3 block = clamp(ivec3(floor(place)), ivec3(0), textureSize(leapField, 0) - 1);
    float radius = float(texelFetch(leapField, block, 0).r);
    vec3 out_ = (vec3(block) + 0.5 + leapSide * (radius - 0.5) - place) * leapMmABlock;
    return min(out_.x, min(out_.y, out_.z));
}

// How many samples from the one at p on cannot show.
int emptySamples(vec3 p, float stepMm_) {
    return int(clamp(emptyMm(p) / stepMm_ + 0.999, 0.0, 1e6));
}

// How many segments from the one that begins at p on cannot show.
int emptySegments(vec3 p, float stepMm_) {
    return int(clamp(emptyMm(p) / stepMm_, 0.0, 1e6));
}
