// Samples at the segment boundaries, entry and exit included, and every crossing of a surface between two of them. An inner loop looks for
// the next segment with a crossing, so that rays drawn side by side meet at their surfaces (compare composeLit in compose/over.glsl).
uniform float stepMm;

void traverse(float tEnter, float tExit) {
    float extent = tExit - tEnter;
    int count = max(int(ceil(extent / stepMm)), 1);
    int next = 1;
    float tFront = tEnter;
    float tBack = tEnter;
    float uFront = 0.0;
    float uBack = reconstruct(ray.texOrigin + tEnter * ray.texDirection);
    int level = levelOf(uBack);
    int target = level;
    while (next <= count || level != target) {
        while (level == target && next <= count) {
            tFront = tBack;
            uFront = uBack;
            // The end itself, not what it rounds to: another part of the ray may begin there, with the same value.
            tBack = next == count ? tExit : min(tEnter + float(next) * stepMm, tExit);
            uBack = reconstruct(ray.texOrigin + tBack * ray.texDirection);
            target = levelOf(uBack);
            ++next;
        }
        if (level != target) {
            int crossed = level < target ? level : level - 1;
            level += level < target ? 1 : -1;
            if (composeCrossing(crossed, tFront, uFront, tBack, uBack)) break;
        }
    }
}
