// Early ray termination: what is still to come can change the picture by no more than the stated bound.
uniform float terminationTransmittance;

bool rayIsDone(float transmittance) {
    return transmittance <= terminationTransmittance;
}
