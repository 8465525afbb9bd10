// Counts the turns of a loop that the driver really takes.
layout(local_size_x = 1) in;
layout(std430, binding = 0) buffer Count {
    uint turns;
};
uniform uint wanted;

void main() {
    uint taken = 0u;
    // The condition depends on what the loop computes, so that it cannot be replaced by its result.
    for (uint state = 1u; taken < wanted && state != 0u; ++taken) state = state * 1664525u + 1013904223u | 1u;
    turns = taken;
}
