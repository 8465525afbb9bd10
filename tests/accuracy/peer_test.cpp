// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Is a peer asked for the picture that it is compared with? Errors must be those of its arithmetic.
#include <gmock/gmock.h>

#include <cmath>

#include "accuracy/metrics.h"
#include "accuracy/peers/peer.h"
#include "accuracy/report_plan.h"
#include "accuracy/report_reference.h"
#include "tests/accuracy/scenes.h"
#include "tests/gui/display.h"

namespace pellucid::test {
namespace {

using namespace accuracy;

/// RMSE of rounding to 8 bits: steps of 1/255, evenly spread.
const double kEightBits = 1.0 / (255.0 * std::sqrt(12.0));

class Peers : public testing::Test {
protected:
    static Grid grid() { return axisAlignedGrid({32, 32, 32}, {1, 1, 1}); }

    /// A smooth ball of 16 bits well inside the box: nothing at its border, opaque to 0.96 in the middle.
    static VolumePtr ball() {
        return sampledVolume(grid(), VoxelType::UInt16, [](glm::ivec3 i) {
            const double r = glm::length(glm::dvec3(i) - 15.5);
            return 25500.0 * std::exp(-r * r / 40.0);
        });
    }
    static Scene ballScene() {
        TransferFunction1D ramp{"ramp", "", {{1000, {1, 0.8, 0.6}, 0.0}, {25500, {1, 1, 1}, 0.3}}};
        Scene scene = sceneOf(ramp, perspectiveAlong(grid(), {0.4, 1, -0.3}, 1.5, 50.0), {48, 32});
        scene.volumes.front().window = Window{12750, 25500};
        return scene;
    }

    static ImageF drawn(const Scene& scene, const VolumePtr& volume, const ReportSetting& setting) {
        const auto frames = drawByPeer(scene, *volume, setting, 1);
        if (!frames) {
            ADD_FAILURE() << frames.error().text();
            return {};
        }
        EXPECT_EQ(frames->warmMs.size(), 1u);
        return frames->image;
    }

    static double rmse(const Scene& whole, const VolumePtr& volume, const char* renderer, double step) {
        const Scene scene = completed(whole, {volume});
        if (const auto why = whyNoPeers(scene, *volume)) {
            ADD_FAILURE() << *why;
            return std::nan("");
        }
        ReportSetting setting;
        setting.renderer = renderer;
        setting.stepVoxels = step;
        ReferenceOptions options;
        options.maxHalvings = 1;
        const auto reference =
            drawReference(scene, volume, referenceOf(setting, scene), scene.picture.size, options);
        if (!reference) {
            ADD_FAILURE() << reference.error().text();
            return std::nan("");
        }
        const ImageF image = drawn(sceneWith(scene, setting, scene.picture.size), volume, setting);
        const auto error = difference(image, reference->image);
        return error ? error->rmse : std::nan("");
    }
};

TEST_F(Peers, ASlabHasItsClosedForm) {
    const double tau = 0.05;
    const double step = 0.25;
    const Scene whole =
        sceneOf(constantFunction({1, 1, 1}, tau), orthographicAlong(grid(), {0, 1, 0}, 20), {8, 8});
    const VolumePtr volume = constantVolume(grid(), 1.0);
    const Scene scene = completed(whole, {volume});
    // Between the outer voxel centres, 31 of 32 voxels. With our box the error would be tau exp(-tau L) =
    // 0.01.
    const double length = 31.0;
    const double exact = 1.0 - std::exp(-tau * length);
    // One step more or less at the end, and rounding: to 8 bits once, or to 15 bits in each of two products a
    // step.
    const double oneStep = tau * step * std::exp(-tau * length);
    const double roundings[] = {0.5 / 255.0, 2.0 * length / step * 0.5 / 32767.0};
    int peer = 0;
    for (const char* renderer : {"vtk-gpu", "vtk-fixed-point"}) {
        ReportSetting setting;
        setting.renderer = renderer;
        setting.stepVoxels = step;
        const ImageF image = drawn(sceneWith(scene, setting, scene.picture.size), volume, setting);
        ASSERT_EQ(image.pixels.size(), 64u);
        EXPECT_NEAR(image.at(4, 4).g, exact, oneStep + roundings[peer++]) << renderer;
    }
}

TEST_F(Peers, ABlockIsWhereItShouldBe) {
    // Oblique, perspective, wider than high, its faces dense: a shift of half a pixel or half a voxel, a
    // mirrored or stretched picture costs 0.05 and more.
    const double tau = 0.05;
    const double step = 0.125;
    const Scene scene =
        sceneOf(constantFunction({1, 1, 1}, tau), perspectiveAlong(grid(), {0.4, 1, -0.3}, 4.0), {48, 32});
    // A ray is at most one step too short or too long: tau * step where nothing is in front of it.
    EXPECT_LT(rmse(scene, constantVolume(grid(), 1.0), "vtk-gpu", step), std::hypot(tau * step, kEightBits));
}

TEST_F(Peers, TheGpuMapperConvergesToItsEightBits) {
    const VolumePtr volume = ball();
    // Smooth and empty at the border: half-voxel steps are exact to far below a grey level. A tenth for the
    // spread of roundings, half a grey level's share for tables of finite size.
    const double bound = 1.5 * kEightBits;
    EXPECT_GT(rmse(ballScene(), volume, "vtk-gpu", 8.0), bound);
    EXPECT_LT(rmse(ballScene(), volume, "vtk-gpu", 0.5), bound);
    Scene mip = ballScene();
    mip.mode = Mode::Mip;
    EXPECT_LT(rmse(mip, volume, "vtk-gpu", 0.25), bound);
    Scene lit = ballScene();
    lit.lights = std::vector<Light>{Light{}};
    lit.material = {0.2, 0.8, 0.0, 10.0};
    EXPECT_LT(rmse(lit, volume, "vtk-gpu", 0.25), bound);
}

TEST_F(Peers, TheFixedPointMapperIsExactToItsFifteenBits) {
    const VolumePtr volume = ball();
    // About 25 mm of the ball are not empty: as many steps of 1 mm, each with two roundings to 1/32767.
    const double bound = 25.0 * 2.0 * 0.5 / 32767.0 + 2e-4;
    EXPECT_LT(rmse(ballScene(), volume, "vtk-fixed-point", 1.0), bound);
    Scene mip = ballScene();
    mip.mode = Mode::Mip;
    EXPECT_LT(rmse(mip, volume, "vtk-fixed-point", 0.25), bound);
    // Lit at the voxels and interpolated: another field of colours, alike where it is smooth. Without the
    // ambient part it would be 0.03 and more.
    Scene lit = ballScene();
    lit.lights = std::vector<Light>{Light{}};
    lit.material = {0.2, 0.8, 0.0, 10.0};
    EXPECT_LT(rmse(lit, volume, "vtk-fixed-point", 1.0), 0.01);
}

TEST_F(Peers, WhatVtkCannotDrawIsLeftOutWithASentence) {
    const auto why = [](const Scene& scene, const VolumePtr& volume) {
        return whyNoPeers(completed(scene, {volume}), *volume).value_or("");
    };
    const Scene scene = ballScene();
    EXPECT_THAT(why(scene, constantVolume(axisAlignedGrid({4, 4, 1}), 1.0)), testing::HasSubstr("empty"));
    EXPECT_THAT(why(scene, constantVolume(axisAlignedGrid({4, 4, 4}), std::nan(""))),
                testing::HasSubstr("no number"));
    Scene xray = scene;
    xray.mode = Mode::XRay;
    EXPECT_THAT(why(xray, ball()), testing::HasSubstr("xray"));
}

}  // namespace
}  // namespace pellucid::test

int main(int argc, char** argv) {
    testing::InitGoogleMock(&argc, argv);
    if (pellucid::test::onlyListsTests()) return RUN_ALL_TESTS();
    pellucid::test::provideDisplay();
    return RUN_ALL_TESTS();
}
