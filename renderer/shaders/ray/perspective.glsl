// Perspective viewing ray. Its origin is its point on the plane `anchor` mm in front of the eye (0: the eye itself).
uniform vec3 rayBase;               // eye + anchor * forward
uniform vec3 rayAnchorRight;        // anchor * rayRight, multiplied in double
uniform vec3 rayAnchorUp;
uniform vec3 rayRight;              // half width and half height as tangents
uniform vec3 rayUp;
uniform vec3 rayForward;            // unit
uniform float rayNearFromAnchorMm;  // near - anchor, along forward

Ray makeRay(vec2 uv) {
    Ray r;
    vec3 along = rayForward + uv.x * rayRight + uv.y * rayUp;
    float stretch = length(along);
    r.origin = rayBase + uv.x * rayAnchorRight + uv.y * rayAnchorUp;
    r.direction = along / stretch;
    r.tNear = rayNearFromAnchorMm * stretch;
    return r;
}
