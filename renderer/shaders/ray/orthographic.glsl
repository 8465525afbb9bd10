// Parallel viewing ray. Its origin lies on the plane `anchor` mm in front of the eye.
uniform vec3 rayBase;
uniform vec3 rayRight;              // half width and half height, mm
uniform vec3 rayUp;
uniform vec3 rayForward;            // unit
uniform float rayNearFromAnchorMm;

Ray makeRay(vec2 uv) {
    Ray r;
    r.origin = rayBase + uv.x * rayRight + uv.y * rayUp;
    r.direction = rayForward;
    r.tNear = rayNearFromAnchorMm;
    return r;
}
