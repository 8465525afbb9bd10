// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Drivers that draw on the CPU end a pixel's loops after some number of turns, right or wrong. Rays of more
// are drawn in slabs one behind the other.
#include "renderer/plan/slabs.h"

#include <algorithm>
#include <cmath>

#include "renderer/plan/skipping.h"
#include "renderer/plan/stages.h"

namespace pellucid::renderer {

namespace {

/// Rays that drivers on the CPU draw together, in step: a loop within a loop goes on until the last of them
/// is done, so at worst the turns of all of them follow one another.
constexpr double kRaysTogether = 16.0;

bool has(const Plan& plan, std::string_view stage, std::string_view variant) {
    return std::any_of(plan.stages.begin(), plan.stages.end(),
                       [&](const StageRow& row) { return row.stage == stage && row.variant == variant; });
}

/// Turns of the loop over lights, for one lit sample. Loops of few turns are unrolled by the compiler and
/// take none: those of the filters (up to 6 x 6 x 6) and over up to 8 lights.
double turnsOverLights(const Plan& plan) {
    constexpr int kUnrolled = 8;
    const bool inLoop = plan.features.lit && !has(plan, "traverse", "boundaries");
    return inLoop && plan.features.lights > kUnrolled ? plan.features.lights + 1.0 : 0.0;
}

/// The halvings of a surface's root, a segment before the loop, and what each loop needs to find its end.
double turnsPerRay(const Plan& plan) {
    return 64.0 + 2.0 * turnsOverLights(plan);
}

/// Why parts of a ray cannot be blended one behind the other; null where they can: what is seen through a
/// part is all that the next one must know. A surface is found where the part with it is drawn, since a part
/// begins with the sample that the one in front ends with.
const char* whyNotInSlabs(const Features& features) {
    if (features.mode == Mode::Isosurface || features.mode == Mode::FirstHit) return nullptr;
    if (features.mode != Mode::Composite) return "the mode needs the whole ray at once";
    if (features.accumulation != Accumulation::Float32) return "sums in few bits are those of the whole ray";
    if (features.integrator == Integrator::Adaptive || features.integrator == Integrator::Importance)
        return "where the steps end is known only when they are taken";
    return nullptr;
}

/// True where a turn of the loop takes four samples.
bool takesFour(const Plan& plan) {
    return has(plan, "traverse", "midpoints_by_four") || has(plan, "traverse", "lit_midpoints_by_four");
}

void setSlabs(Plan& plan, int slabs) {
    plan.slabs = slabs;
    Features features = plan.features;
    features.slabs = slabs > 1;
    if (features != plan.features) changeFeatures(plan, features);
}

/// The fewest slabs whose turns the driver gives; above kMostSlabs when there are none.
double slabsNeeded(const Plan& plan, const DeviceLimits& limits) {
    const double most = std::floor((limits.maxLoopTurns - turnsPerRay(plan)) / turnsPerSample(plan));
    return std::ceil(plan.samplesPerRay / std::max(most, 1.0));
}

}  // namespace

double turnsPerSample(const Plan& plan) {
    // A loop takes one turn more than its body, the one that finds it at its end.
    const double overLights = turnsOverLights(plan);
    const bool segments = has(plan, "traverse", "segments");
    double turns = takesFour(plan) ? 0.25 : 1.0;
    // A lit sample: one turn to light it, one to find that the search for it is at its end, and those of the
    // search, leaps included.
    if (plan.features.lit && has(plan, "compose", "over")) return 2.0 + kRaysTogether + overLights;
    // A segment is searched for like that; each surface crossed in it takes a turn and what lights it.
    if (plan.features.surfaces > 0) return kRaysTogether + plan.features.surfaces * (2.0 + overLights);
    if (has(plan, "traverse", "adaptive")) return turns + 3.0 * overLights;
    // A loop of leaps, none over less than four samples, in the loop of samples; its end, and of segments
    // the loop over four.
    if (plan.features.skipping == Skipping::Leaps && (takesFour(plan) || segments))
        turns += kRaysTogether / 4.0 + (segments ? 1.0 : 0.25);
    return turns + overLights;
}

double samplesPerSlab(const Plan& plan) {
    return std::ceil(plan.samplesPerRay / plan.slabs);
}

Result<void> fitLoops(Plan& plan, const DeviceLimits& limits) {
    constexpr double kMostSlabs = 64.0;
    const char* whyNot = whyNotInSlabs(plan.features);
    const double allowed = whyNot == nullptr ? kMostSlabs : 1.0;
    if (plan.features.skipping == Skipping::Leaps && slabsNeeded(plan, limits) > allowed)
        giveUpLeaps(plan, "rays of so many samples leave the driver no turns of its loops for them");
    const double slabs = slabsNeeded(plan, limits);
    if (slabs > allowed)
        return fail(
            ErrorCode::InvalidArgument,
            fmt::format(
                "/quality: a step of {:g} mm makes {:.0f} samples on the longest ray of {:g} loop turns "
                "each; this OpenGL driver ends loops after {:.0f} turns, and rays are {} slabs{}: take "
                "a longer step",
                plan.stepMm, plan.samplesPerRay, turnsPerSample(plan), limits.maxLoopTurns,
                whyNot != nullptr ? "not drawn in" : fmt::format("drawn in at most {:g}", kMostSlabs),
                whyNot != nullptr ? fmt::format(" ({})", whyNot) : ""));
    setSlabs(plan, static_cast<int>(slabs));
    return {};
}

}  // namespace pellucid::renderer
