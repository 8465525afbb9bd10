// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Passing over what cannot show changes no picture: the same samples are taken on the same grid, grouped
// alike, and those left out would have added exactly nothing.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <random>

#include "scene/names.h"
#include "tests/accuracy/gpu_fixture.h"

namespace pellucid::test {
namespace {

constexpr glm::dvec3 kOblique(0.4, 1.0, -0.3);

/// Turned, sheared and anisotropic.
Grid obliqueGrid(glm::ivec3 size) {
    Grid grid = axisAlignedGrid(size, {1.0, 0.7, 1.6}, {12.0, -40.0, 7.0});
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), 0.6, glm::dvec3(0.3, -0.8, 0.5));
    glm::dmat4 shear(1.0);
    shear[2][0] = 0.3;
    grid.patientFromIndex = turn * shear * grid.patientFromIndex;
    return grid;
}

/// A few soft balls of up to 1 in 0 (inverted: of 0 in 1); sizes are no multiples of a block's.
VolumePtr ballsVolume(const Grid& grid, VoxelType type = VoxelType::Float32, bool inverted = false) {
    struct Ball {
        glm::dvec3 centre;
        double radius;
    };
    const glm::dvec3 size(grid.size);
    const Ball balls[] = {{{0.25, 0.3, 0.3}, 0.14}, {{0.55, 0.45, 0.5}, 0.13}, {{0.5, 0.8, 0.75}, 0.11}};
    const double scale = type == VoxelType::Float32 ? 1.0 : 1000.0;
    return accuracy::sampledVolume(
        grid, type,
        [=](glm::ivec3 i) {
            double value = 0.0;
            for (const Ball& ball : balls) {
                const double r = glm::length((glm::dvec3(i) + 0.5) / size - ball.centre) / ball.radius;
                value = std::max(value, std::clamp(1.6 - 1.2 * r, 0.0, 1.0));
            }
            return scale * (inverted ? 1.0 - value : value);
        },
        {1.0 / scale, 0.0, ""});
}

TransferFunction1D sparseFunction() {
    return {"sparse",
            "",
            {{0.0, {0.1, 0.2, 0.9}, 0.0},
             {0.2, {0.1, 0.2, 0.9}, 0.0},
             {0.5, {0.2, 0.9, 0.3}, 0.3},
             {0.7, {0.9, 0.8, 0.1}, 0.0},
             {0.8, {0.9, 0.8, 0.1}, 0.0},
             {0.8, {1.0, 0.3, 0.2}, 2.0}}};
}

class SkippingTest : public GpuTest {
protected:
    /// The largest difference that skipping makes; counts whether it did anything.
    double change(Scene scene, const VolumePtr& volume) {
        scene.quality.skipEmpty = true;
        const auto with = frameOf(scene, volume);
        scene.quality.skipEmpty = false;
        const auto without = frameOf(scene, volume);
        EXPECT_EQ(without.plan.features.skipping, renderer::Skipping::None);
        leapt += with.plan.features.skipping == renderer::Skipping::Leaps ? 1 : 0;
        ++drawn;
        for (const glm::vec4& pixel : without.image.pixels)
            if (pixel != without.image.pixels.front()) {
                ++structured;
                break;
            }
        return largestDifference(with.image, without.image);
    }
    int leapt = 0, drawn = 0, structured = 0;
};

Scene ballsScene(const Grid& grid, Mode mode) {
    Scene scene = sceneOf(sparseFunction(), perspectiveAlong(grid, kOblique, 2.6), {24, 20});
    scene.mode = mode;
    scene.hitOpacity = 0.2;
    scene.volumes[0].window = Window{0.6, 0.9};
    return scene;
}

/// Not a bit differs, in any mode, filter and projection, lit and not, with and without jitter and an early
/// end of rays, on a sheared grid. Programs take long to compile, so filters meet one mode of each traversal.
TEST_F(SkippingTest, ChangesNoBitInAnyModeFilterAndView) {
    const VolumePtr volume = ballsVolume(obliqueGrid({45, 38, 31}));
    const VolumePtr holes = ballsVolume(volume->grid(), VoxelType::Float32, true);
    int turn = 0;
    int skippable = 0;
    const auto check = [&](Mode mode, Filter filter, bool lit) {
        Scene scene = ballsScene(volume->grid(), mode);
        if (mode == Mode::MinIp) scene.volumes[0].window = Window{0.4, 0.9};
        scene.volumes[0].filter = filter;
        if (turn % 2 == 1) scene.camera = orthographicAlong(volume->grid(), {-0.2, 0.1, 0.9}, 30.0);
        if (lit) scene.lights->push_back(Light{});
        scene.quality.jitter = turn / 2 % 2 == 0;
        scene.quality.earlyTermination = turn % 3 == 0 ? 1.0 / 64.0 : 0.0;
        scene.quality.stepVoxels = turn % 3 == 1 ? 1.7 : 0.5;
        EXPECT_EQ(change(scene, mode == Mode::MinIp ? holes : volume), 0.0)
            << name(mode) << ' ' << name(filter) << ' ' << turn;
        skippable += mode == Mode::Average || mode == Mode::Slice ? 0 : 1;
        ++turn;
    };
    for (const Mode mode : allModes()) check(mode, Filter::Trilinear, false);
    for (const Mode mode : {Mode::Composite, Mode::FirstHit, Mode::Isosurface})
        check(mode, Filter::Trilinear, true);
    for (const Filter filter : allFilters()) check(Mode::Composite, filter, false);
    check(Mode::Composite, Filter::TricubicBSpline, true);
    check(Mode::FirstHit, Filter::CatmullRom, false);
    check(Mode::Mip, Filter::CatmullRom, false);
    EXPECT_EQ(leapt, skippable);
    EXPECT_EQ(structured, drawn);
}

TEST_F(SkippingTest, ChangesNoBitWithAnyIntegrator) {
    const VolumePtr volume = ballsVolume(obliqueGrid({45, 38, 31}), VoxelType::UInt16);
    int turn = 0;
    int wanted = 0;
    for (const Mode mode : {Mode::Composite, Mode::XRay})
        for (const auto& integrator : enumNames<Integrator>())
            for (int half = 0; half < 2; ++half, ++turn) {
                if (half == 1 && (mode == Mode::XRay || turn % 4 != 1)) continue;
                ++wanted;
                if (integrator.value == Integrator::Adaptive || integrator.value == Integrator::Importance)
                    --wanted;
                Scene scene = ballsScene(volume->grid(), mode);
                scene.quality.integrator = integrator.value;
                if (half == 1) scene.volumes[0].filter = Filter::TricubicBSpline;
                if (half == 0 && turn % 3 == 0) scene.lights->push_back(Light{});
                scene.quality.accumulation = enumNames<Accumulation>()[turn % 3].value;
                scene.quality.jitter = turn % 2 == 0;
                scene.quality.earlyTermination = turn / 2 % 2 == 0 ? 1.0 / 64.0 : 0.0;
                scene.quality.stepVoxels = turn % 2 == 0 ? 0.5 : 1.7;
                // Running integrals are floats: where the function is 0, their interpolation differs by
                // roundings (2 of 2^-24 of an integral of some hundred entries) that 100 segments of 1 mm add
                // up.
                const bool rounds = integrator.value == Integrator::IntegralFunctions;
                EXPECT_LE(change(scene, volume), rounds ? 1e-5 : 0.0) << name(mode) << ' ' << integrator.name;
            }
    EXPECT_EQ(leapt, wanted);
}

/// Functions of random points, peaks narrower than a table entry and steps among them, on random data, from
/// inside and outside; each edit changes one point.
TEST_F(SkippingTest, ChangesNoBitUnderRandomFunctionsAndCameras) {
    std::mt19937 random(7);
    const auto uniform = [&](double lo, double hi) {
        return std::uniform_real_distribution<double>(lo, hi)(random);
    };
    const VolumePtr balls = ballsVolume(obliqueGrid({45, 38, 31}), VoxelType::UInt16);
    Scene scene = ballsScene(balls->grid(), Mode::Composite);
    for (int i = 0; i < 60; ++i) {
        std::vector<TransferPoint> points;
        double value = uniform(-0.2, 0.3);
        const auto count = 1 + random() % 8;
        while (points.size() < count) {
            const double extinction = random() % 2 == 0 ? 0.0 : std::pow(10.0, uniform(-3.0, 3.0));
            points.push_back({value, {uniform(0, 1), uniform(0, 1), uniform(0, 1)}, extinction});
            value += random() % 3 == 0 ? 0.0 : random() % 3 == 0 ? 1e-6 : uniform(0.0, 0.4);
        }
        scene.volumes[0].transferFunction->points = points;
        scene.mode = std::array{Mode::Composite, Mode::XRay, Mode::Mip, Mode::Isosurface}[random() % 4];
        scene.volumes[0].filter =
            scene.mode == Mode::Composite && i % 2 == 0 ? Filter::CatmullRom : Filter::Trilinear;
        scene.volumes[0].isovalue = uniform(-0.2, 1.2);
        scene.volumes[0].window = Window{uniform(-0.5, 1.5), uniform(0.01, 1.0)};
        scene.hitOpacity = uniform(0.01, 0.99);
        scene.quality.stepVoxels = uniform(0.2, 4.0);
        scene.quality.integrator =
            std::array{Integrator::Exponential, Integrator::Preintegrated2D}[random() % 2];
        const glm::dvec3 forward(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
        scene.camera = random() % 2 == 0 ? orthographicAlong(balls->grid(), forward, uniform(5.0, 60.0))
                                         : perspectiveAlong(balls->grid(), forward, uniform(0.0, 2.5), 60.0);
        EXPECT_EQ(change(scene, balls), 0.0) << i << ' ' << name(scene.mode);
    }
    EXPECT_GT(leapt, 10);
}

/// Rays along the axes run on block borders and lie in the planes of the box. Planes of voxels stand next to
/// the borders, one and two voxels into a block, where only the outer weights of cubic filters see them from
/// the next block: up to (1/2)^3 / 6 = 0.02 of the B-spline's.
TEST_F(SkippingTest, ChangesNoBitOnBlockBorders) {
    const Grid grid = axisAlignedGrid({33, 32, 40});
    const VolumePtr volume =
        accuracy::sampledVolume(grid, VoxelType::UInt8,
                                [](glm::ivec3 i) {
                                    const bool corner = i.x % 16 == 3 && i.y % 16 == 8 && i.z % 16 == 4;
                                    return corner || i.x == 17 || i.y == 14 || i.z == 22 ? 200.0 : 0.0;
                                },
                                {1.0 / 200.0, 0.0, ""});
    for (const Filter filter :
         {Filter::Nearest, Filter::Trilinear, Filter::TricubicBSpline, Filter::CatmullRom})
        for (int axis = 0; axis < 3; ++axis)
            for (const double side : {1.0, -1.0}) {
                glm::dvec3 forward(0.0);
                forward[axis] = side;
                Scene scene = ballsScene(grid, axis == 1 ? Mode::XRay : Mode::Composite);
                scene.volumes[0].filter = filter;
                scene.volumes[0].transferFunction->points = {{0.008, {1, 1, 1}, 0.0}, {1.0, {0, 1, 1}, 3.0}};
                scene.quality.stepVoxels = 0.3;
                scene.picture.size = {33, 33};
                scene.camera = orthographicAlong(grid, forward, 33.0);
                EXPECT_EQ(change(scene, volume), 0.0) << name(filter) << ' ' << axis;
            }
    EXPECT_EQ(leapt, drawn);
}

/// Shapes and data at the edge of what there is.
TEST_F(SkippingTest, ChangesNoBitOnExtremeVolumes) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double huge = std::numeric_limits<double>::infinity();
    const auto holes = [&](glm::ivec3 i) {
        const int n = i.x + 3 * i.y + 7 * i.z;
        return n % 11 == 0 ? nan : n % 13 == 0 ? huge : n % 17 == 0 ? 1.0 : 0.0;
    };
    const std::vector<VolumePtr> volumes{
        constantVolume(axisAlignedGrid({1, 1, 1}), 1.0), constantVolume(axisAlignedGrid({9, 9, 9}), 0.9),
        accuracy::sampledVolume(axisAlignedGrid({1, 57, 2}), VoxelType::Float64, holes),
        accuracy::sampledVolume(axisAlignedGrid({200, 1, 1}), VoxelType::Float32, holes),
        accuracy::sampledVolume(axisAlignedGrid({30, 20, 10}, {1e5, 1e3, 1e4}), VoxelType::Float32, holes),
        accuracy::sampledVolume(axisAlignedGrid({30, 20, 10}, {1e-6, 1e-7, 1e-6}), VoxelType::Float32, holes),
        // One outlier takes the whole range: all else is one quantum.
        accuracy::sampledVolume(axisAlignedGrid({20, 20, 20}), VoxelType::Float32,
                                [](glm::ivec3 i) { return i == glm::ivec3(7) ? 1e30 : 0.01 * i.x; }),
        // Values run against the stored ones.
        accuracy::sampledVolume(axisAlignedGrid({21, 22, 23}), VoxelType::Int8,
                                [](glm::ivec3 i) { return i.x / 8 == 1 && i.y / 6 == 2 ? 0.0 : 100.0; },
                                {-0.01, 1.0, ""})};
    for (std::size_t v = 0; v < volumes.size(); ++v)
        for (const Mode mode : {Mode::Composite, Mode::Mip, Mode::FirstHit})
            for (const double density : {1.0, 0.0, 1e4}) {
                if (density != 1.0 && mode != Mode::Composite) continue;
                Scene scene = ballsScene(volumes[v]->grid(), mode);
                scene.picture.size = {10, 8};
                scene.unitLengthMm = meanSpacingMm(volumes[v]->grid());
                scene.densityScale = density;
                EXPECT_EQ(change(scene, volumes[v]), 0.0) << v << ' ' << name(mode) << ' ' << density;
                if (density != 1.0 || mode != Mode::Composite) continue;
                scene.volumes[0].filter = Filter::CatmullRom;
                EXPECT_EQ(change(scene, volumes[v]), 0.0) << v << ' ' << name(mode) << " catmull-rom";
            }
}

/// What is left out is in the plan, and why.
TEST_F(SkippingTest, PlanSaysWhatTheBlocksShowed) {
    const VolumePtr volume = ballsVolume(axisAlignedGrid({45, 38, 31}));
    Scene scene = ballsScene(volume->grid(), Mode::Composite);
    const auto reason = [&](const char* what) {
        for (const auto& row : frameOf(scene, volume).plan.leftOut)
            if (row.what == what) return row.reason;
        return std::string();
    };
    EXPECT_EQ(reason("empty blocks"), "");
    // Every value shows: nothing to look for.
    scene.volumes[0].transferFunction->points.front().extinction = 0.1;
    scene.volumes[0].transferFunction->points[1].extinction = 0.1;
    scene.volumes[0].transferFunction->points[3].extinction = 0.1;
    scene.volumes[0].transferFunction->points[4].extinction = 0.1;
    EXPECT_EQ(reason("empty blocks"), "every value of the data can show");
    // Only the value 1 does not show, and no block holds nothing else.
    scene.volumes[0].transferFunction->points = {{0.0, {1, 1, 1}, 0.5}, {0.9, {1, 1, 1}, 0.0}};
    EXPECT_NE(reason("empty blocks"), "");
    EXPECT_EQ(frameOf(scene, volume).plan.features.skipping, renderer::Skipping::None);
}

}  // namespace
}  // namespace pellucid::test
