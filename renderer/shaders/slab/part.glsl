// One part of the ray, in mm from where it enters the volume; parts are blended from front to back. Each is a whole number of steps (the
// first one has the shorter step of a jittered start besides), so that together they take the samples of the whole ray.
uniform float slabFromMm;   // 0: the first part
uniform float slabToMm;     // of one part what slabFromMm is of the next
uniform float slabStepMm;   // a step

//@when jitter
float rayShift();
//@end

void cutToSlab(inout float tEnter, inout float tExit) {
    float whole = tEnter;
    //@when jitter
    whole += rayShift() * slabStepMm;
    //@end
    if (slabFromMm > 0.0) tEnter = whole + slabFromMm;
    tExit = min(tExit, whole + slabToMm);
}
