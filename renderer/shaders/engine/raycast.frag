// Single-pass ray casting of one volume (Engel et al. 2006, section 7.2): set up the ray, clip it to the volume, let
// `traverse` visit it, finish the picture.

struct Ray {
    vec3 origin;       // render coordinates, mm
    vec3 direction;    // unit
    float tNear;       // the ray starts here at the earliest
    vec3 texOrigin;    // the same ray in texture coordinates
    vec3 texDirection; // per mm
};

uniform vec2 pictureSize;      // pixels of the whole picture
uniform float targetStride;    // pixels of the picture from one of this target to the next
uniform vec2 targetOrigin;     // where the target's lower left corner lies in the picture, pixels
uniform mat4 textureFromRender;
uniform vec3 background;       // in the compositing space; zero for a transparent picture

// The place of this ray in the picture, pixels; the centre of the lowest left pixel is (0.5, 0.5).
vec2 picturePlace() {
    return gl_FragCoord.xy * targetStride + targetOrigin;
}

Ray ray;
bool inVolume;  // the ray meets the volume, whether or not samples are taken

//@stages

// Entry and exit of the ray in [0, 1]^3 by slabs. An axis along which the ray moves by less than float resolution of the
// box limits nothing, but the ray must lie inside its two planes.
bool intersectVolume(out float tEnter, out float tExit) {
    vec3 speed = abs(ray.texDirection);
    bvec3 still = lessThanEqual(speed, vec3(1e-7 * max(speed.x, max(speed.y, speed.z))));
    vec3 distanceOut = max(-ray.texOrigin, ray.texOrigin - 1.0);
    if (any(greaterThan(mix(vec3(-1.0), distanceOut, still), vec3(0.0)))) return false;
    vec3 inverse = 1.0 / mix(ray.texDirection, vec3(1.0), still);
    vec3 a = -ray.texOrigin * inverse;
    vec3 b = (1.0 - ray.texOrigin) * inverse;
    vec3 lo = mix(min(a, b), vec3(-3e38), still);
    vec3 hi = mix(max(a, b), vec3(3e38), still);
    tEnter = max(max(lo.x, lo.y), max(lo.z, ray.tNear));
    tExit = min(hi.x, min(hi.y, hi.z));
    return tExit > tEnter;
}

layout(location = 0) out vec4 pixel;

void main() {
    vec2 uv = 2.0 * picturePlace() / pictureSize - 1.0;
    ray = makeRay(uv);
    ray.texOrigin = (textureFromRender * vec4(ray.origin, 1.0)).xyz;
    ray.texDirection = mat3(textureFromRender) * ray.direction;
    composeBegin();
    //@when leap
    leapBegin();
    //@end
    float tEnter, tExit;
    inVolume = intersectVolume(tEnter, tExit);
    //@when slab
    if (inVolume) {
        cutToSlab(tEnter, tExit);
        if (tExit > tEnter) traverse(tEnter, tExit);
    }
    //@end
    //@unless slab
    if (inVolume) traverse(tEnter, tExit);
    //@end
    //@when refine
    if (inVolume) refine(tEnter, tExit);
    //@end
    vec4 result = composeEnd();
    vec3 color = result.rgb + (1.0 - result.a) * background;
    //@when encode
    color = encodePicture(color, result.a);
    //@end
    pixel = vec4(color, result.a);
}
