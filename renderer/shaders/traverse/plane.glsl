// One sample where the ray meets the plane through the camera's target, perpendicular to the view.
uniform vec3 planeForward;         // unit normal of the plane
uniform float planeFromAnchorMm;   // along it, from the plane of the ray origins

void traverse(float tEnter, float tExit) {
    float t = planeFromAnchorMm / dot(ray.direction, planeForward);
    if (t < tEnter || t > tExit) return;
    vec3 p = ray.texOrigin + t * ray.texDirection;
    composeSample(reconstruct(p), p, t, 0.0);
}
