// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Fewer rays than pixels: the pixels without a ray are as right as was asked, the others are the same bits.
#include "accuracy/metrics.h"
#include "tests/accuracy/estimate_judge.h"

namespace pellucid::test {
namespace {

class SparseRaysGpu : public GpuTest {
protected:
    static Scene sceneOf(Mode mode, bool lit, const VolumePtr& volume) {
        Scene scene = completed(sceneIn(mode, lit), {volume});
        scene.picture.size = {200, 150};
        return scene;
    }

    static renderer::Frame sparse(Scene scene, const VolumePtr& volume, double greyLevels, ErrorNorm norm) {
        scene.quality.interpolationGreyLevels = greyLevels;
        scene.quality.toleranceNorm = norm;
        return frameOf(scene, volume);
    }
};

TEST_F(SparseRaysGpu, StayWithinTheToleranceAndSaveRays) {
    const VolumePtr volume = accuracy::ctLikeShells(48);
    for (const auto& [mode, lit] : {std::pair(Mode::Composite, false),
                                    {Mode::Composite, true},
                                    {Mode::Mip, false},
                                    {Mode::XRay, false}}) {
        Scene scene = sceneOf(mode, lit, volume);
        // Long steps make rings a pixel wide, which rays at every fourth pixel take for a smooth picture.
        scene.quality.stepVoxels = 0.125;
        const ImageF full = draw(scene, volume);
        const double pixels = static_cast<double>(full.pixels.size());
        for (const double greyLevels : {4.0, 1.0, 0.25}) {
            const std::string what = fmt::format("{} {} {}", name(mode), lit, greyLevels);
            const renderer::Frame rms = sparse(scene, volume, greyLevels, ErrorNorm::Rmse);
            EXPECT_LE(255.0 * accuracy::difference(rms.image, full)->rmse, greyLevels) << what;
            // All three lattices at most: a ray a pixel, a quarter, a sixteenth, and the margin around them.
            EXPECT_LT(static_cast<double>(rms.cost.rays), 1.5 * pixels) << what;
            if (greyLevels == 4.0) {
                EXPECT_LT(static_cast<double>(rms.cost.rays), 0.7 * pixels) << what;
            }
        }
    }
}

/// The pixels' own rays are the same ones, by whatever tiles they are drawn.
TEST_F(SparseRaysGpu, ATinyToleranceGivesTheFullPicture) {
    const VolumePtr volume = accuracy::randomVolume(axisAlignedGrid({24, 20, 22}), 7);
    for (const bool jitter : {false, true}) {
        Scene scene = sceneOf(Mode::Composite, true, volume);
        scene.quality.jitter = jitter;
        const ImageF full = draw(scene, volume);
        const renderer::Frame frame = sparse(scene, volume, 1e-6, ErrorNorm::Max);
        // Background between rays that see nothing is interpolated, exactly.
        EXPECT_EQ(largestDifference(frame.image, full), 0.0) << jitter;
        EXPECT_GT(frame.cost.rays, 200 * 150 / 4);
    }
}

TEST_F(SparseRaysGpu, AFieldWithoutDetailTakesASixteenthOfTheRays) {
    const VolumePtr volume = accuracy::sampledVolume(
        axisAlignedGrid(glm::ivec3(32)), VoxelType::Float32,
        [](glm::ivec3 i) { return 0.5 + 0.2 * std::sin(0.1 * i.x) * std::cos(0.08 * i.y + 0.05 * i.z); });
    Scene scene = sceneOf(Mode::Composite, false, volume);
    scene.camera.zoom = 4.0;  // no edge of the volume in the picture
    const ImageF full = draw(scene, volume);
    const renderer::Frame frame = sparse(scene, volume, 0.5, ErrorNorm::Max);
    EXPECT_LE(255.0 * largestDifference(frame.image, full), 0.5);
    EXPECT_LT(static_cast<double>(frame.cost.rays), 0.15 * 200.0 * 150.0);
}

/// What is drawn without a ray counts as error of the picture, and the picture compared with has them all.
TEST_F(SparseRaysGpu, TheEstimateSeesInterpolation) {
    const VolumePtr volume = accuracy::ctLikeShells(48);
    Scene scene = sceneOf(Mode::Composite, true, volume);
    scene.quality.stepVoxels = 0.125;
    scene.quality.interpolationGreyLevels = 6.0;
    renderer::RenderOptions options;
    options.estimateError = true;
    options.estimateReduction = 1;
    const renderer::Frame frame = frameOf(scene, volume, options);
    scene.quality.interpolationGreyLevels.reset();
    const double truth = accuracy::difference(frame.image, draw(scene, volume))->rmse;
    ASSERT_TRUE(frame.error);
    EXPECT_GT(frame.error->rmse, 0.9 * truth);
    EXPECT_GT(truth, 1.0 / 255.0);
}

}  // namespace
}  // namespace pellucid::test
