// Eight samples more around the extreme one, half a step to both sides: what the step missed of the peak it lies on. Peaks between
// other samples are still missed.
void refine(float tEnter, float tExit) {
    if (abs(extreme) > 2e38) return;  // no sample can show
    float from = max(extremeAt - 0.5 * stepMm, tEnter);
    float to = min(extremeAt + 0.5 * stepMm, tExit);
    for (int i = 0; i < 8; ++i) {
        float t = mix(from, to, (float(i) + 0.5) / 8.0);
        vec3 p = ray.texOrigin + t * ray.texDirection;
        composeSample(reconstruct(p), p, t, 0.0);
    }
}
