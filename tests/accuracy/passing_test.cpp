// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Pictures in passing beside the still one: as bright, and as wrong as stated.

#include "renderer/refinement.h"
#include "renderer/resize.h"
#include "scene/presets.h"
#include "tests/accuracy/gpu_fixture.h"

namespace pellucid::test {
namespace {

using renderer::kReductions;
using renderer::kStepTimes;
using renderer::Passing;

using PassingTest = GpuTest;

glm::dvec3 meanOf(const ImageF& image) {
    glm::dvec3 sum(0.0);
    for (const glm::vec4& pixel : image.pixels) sum += glm::dvec3(pixel);
    return sum / static_cast<double>(image.pixels.size());
}

/// As the desktop draws it.
renderer::Frame inPassing(renderer::Renderer& gpu, const Scene& scene, const VolumePtr& volume,
                          const Passing& passing) {
    Scene quick = scene;
    quick.picture.size = renderer::reducedSize(scene.picture.size, passing.reduction);
    quick.quality = renderer::passingQuality(scene.quality, std::nullopt, passing.stepTimes);
    auto frame = gpu.render(quick, {volume});
    if (frame) frame->image = renderer::resized(frame->image, scene.picture.size);
    return std::move(frame.value());
}

struct PassingCase {
    const char* name;
    Mode mode;
    const char* preset;
    double density;
    bool lit;
};

TEST_F(PassingTest, AreAsBrightAsTheStillPictureAndAsWrongAsStated) {
    const VolumePtr volume = accuracy::ctLikeShells(96);
    for (const PassingCase& c : {PassingCase{"faint", Mode::Composite, "CT general", 0.05, false},
                                 PassingCase{"bone, lit", Mode::Composite, "CT bone", 1.0, true},
                                 PassingCase{"maximum", Mode::Mip, "CT general", 1.0, false},
                                 PassingCase{"X-ray", Mode::XRay, "CT general", 0.02, false},
                                 PassingCase{"surface", Mode::Isosurface, "CT general", 1.0, true}}) {
        SCOPED_TRACE(c.name);
        Scene scene;
        scene.volumes.emplace_back();
        scene.mode = c.mode;
        ASSERT_NE(findVolumePreset(c.preset), nullptr);
        if (usesTransferFunction(c.mode))
            scene.volumes.front().transferFunction = findVolumePreset(c.preset)->function;
        scene.densityScale = c.density;
        scene.lights = c.lit ? std::vector<Light>{Light{}} : std::vector<Light>{};
        scene.picture.size = {384, 288};
        renderer::Refinement refinement(completed(scene, {volume}));
        renderer::Frame still;
        while (!refinement.isMeasuring() && !refinement.isDone()) {
            auto frame = gpu().render(refinement.next(), {volume});
            ASSERT_TRUE(frame);
            still = *refinement.take(std::move(*frame));
        }
        ASSERT_TRUE(refinement.passingErrors() && refinement.passingErrors()->byStep);
        renderer::InteractionControl control(100.0);
        control.learned(*refinement.passingErrors());
        const glm::dvec3 bright = meanOf(still.image);
        EXPECT_GT(bright.r, 5.0 / 255.0) << "an empty picture proves nothing";
        for (const double reduction : kReductions) {
            for (const double stepTimes : kStepTimes) {
                // Half of the levels, each with one other.
                if (reduction > 6.0 || (reduction != 1.0 && reduction != 3.0 && stepTimes == 4.0)) continue;
                const Passing passing{reduction, stepTimes};
                const auto frame = inPassing(gpu(), scene, volume, passing);
                const glm::dvec3 apart = meanOf(frame.image) - bright;
                for (int i = 0; i < 3; ++i)
                    EXPECT_LT(std::abs(apart[i]) * 255.0, 1.0) << reduction << " " << stepTimes;
                // Of luminance (Rec. 709 weights) one in a hundred, where the rays are not so few that the
                // mean over them is not known to that.
                const glm::dvec3 luminance(0.2126, 0.7152, 0.0722);
                if (reduction <= 3.0) {
                    EXPECT_LT(std::abs(glm::dot(luminance, apart)), 0.01 * glm::dot(luminance, bright))
                        << reduction << " " << stepTimes;
                }
                const double error = renderer::pictureError(frame.image, still.image).rmse;
                if (passing == Passing{}) {
                    EXPECT_EQ(error, 0.0);
                    continue;
                }
                EXPECT_GT(*control.error(passing), error / 2.0) << reduction << " " << stepTimes;
                EXPECT_LT(*control.error(passing), error * 2.0 + 0.1 / 255.0)
                    << reduction << " " << stepTimes;
            }
        }
    }
}

TEST_F(PassingTest, HalfTheSizeTracesAQuarterOfTheRays) {
    // Section 8.8 of Engel et al.: k times fewer rays along each axis are k^2 times fewer, each as long as
    // before. What that saves of the time is for benchmarks to say.
    const VolumePtr volume = accuracy::ctLikeShells(96);
    Scene scene;
    scene.picture.size = {512, 384};
    const auto full = inPassing(gpu(), scene, volume, {});
    const auto half = inPassing(gpu(), scene, volume, {2.0, 1.0});
    EXPECT_EQ(full.cost.rays, 512 * 384);
    EXPECT_EQ(half.cost.rays, 256 * 192);
    EXPECT_EQ(half.plan.samplesPerRay, full.plan.samplesPerRay);
}

}  // namespace
}  // namespace pellucid::test
