// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Steps that follow how much the data bend (docs/equations.md, 22).
#include "renderer/plan/importance.h"

#include <gmock/gmock.h>

#include <random>

#include "accuracy/field.h"
#include "accuracy/metrics.h"
#include "tests/accuracy/gpu_fixture.h"

namespace pellucid::test {
namespace {

using renderer::ImportanceGrid;

constexpr glm::dvec3 kOblique(0.4, 1.0, -0.3);

ImportanceGrid bendsOf(const Volume& volume) {
    auto grid = renderer::importanceOf(volume, 0);
    EXPECT_TRUE(grid) << (grid ? "" : grid.error().text());
    return grid.value_or(ImportanceGrid{});
}

glm::vec2 bendAt(const ImportanceGrid& grid, glm::dvec3 index) {
    const glm::ivec3 block =
        glm::clamp(glm::ivec3(glm::floor((index + 0.5) / 4.0)), glm::ivec3(0), grid.size - 1);
    return grid.bends[static_cast<std::size_t>((block.z * grid.size.y + block.y) * grid.size.x + block.x)];
}

/// A smooth hill, and noise in one corner.
double hillAndNoise(glm::ivec3 i, int size, std::mt19937& random) {
    const glm::dvec3 d = (glm::dvec3(i) - 0.5 * (size - 1.0)) / (0.5 * size);
    const double noise = static_cast<double>(random()) * 0x1p-32;
    const bool corner = i.x > 2 * size / 3 && i.y > 2 * size / 3 && i.z > 2 * size / 3;
    return 0.8 * std::exp(-8.0 * glm::dot(d, d)) + (corner ? 0.2 * noise : 0.0);
}

VolumePtr hillVolume(const Grid& grid) {
    std::mt19937 random(11);
    const int size = grid.size.x;
    return accuracy::sampledVolume(grid, VoxelType::Float32,
                                   [&](glm::ivec3 i) { return hillAndNoise(i, size, random); });
}

/// The promise itself: along any segment as long as its block allows, the reconstructed value stays within
/// the tolerance of the line between its ends. Square, flat and sheared voxels; from any place in any
/// direction.
TEST(Importance, SegmentsBendByNoMoreThanTheTolerance) {
    Grid sheared = axisAlignedGrid({32, 32, 32}, {0.8, 1.0, 1.5});
    sheared.patientFromIndex[1][0] = 0.6;
    std::mt19937 random(5);
    const auto next = [&] { return static_cast<double>(random()) * 0x1p-32; };
    for (const Grid& grid :
         {axisAlignedGrid({32, 32, 32}), axisAlignedGrid({32, 32, 32}, {0.4, 1.0, 2.5}), sheared})
        for (const Filter filter : {Filter::Trilinear, Filter::TricubicBSpline}) {
            const VolumePtr volume = hillVolume(grid);
            const ImportanceGrid bends = bendsOf(*volume);
            const accuracy::Field field(*volume, 0, filter);
            const double range = volume->physicalRange().hi - volume->physicalRange().lo;
            const double layer = renderer::layerMm(grid);
            const double longest = renderer::longestImportanceStepMm(grid, filter);
            const glm::dmat4 toIndex = indexFromPatient(grid);
            double worst = 0.0;
            int longSteps = 0;
            for (int n = 0; n < 20000; ++n) {
                const double tolerance = std::pow(10.0, -1.0 - 3.0 * next());
                const glm::dvec3 start = 32.0 * glm::dvec3(next(), next(), next()) - 0.5;
                const glm::dvec3 unit = glm::normalize(glm::dvec3(next(), next(), next()) - 0.5);
                const double step =
                    renderer::importanceStepMm(bendAt(bends, start), filter, tolerance, layer, 0.0, longest);
                if (step > layer) ++longSteps;
                const glm::dvec3 along = step * transformVector(toIndex, unit);
                const auto at = [&](double s) {
                    const glm::dvec3 p = start + s * along;
                    return field.value(field.cellOf(p), p) / range;
                };
                const double from = at(0.0), to = at(1.0);
                for (int k = 1; k < 12; ++k) {
                    const double s = k / 12.0;
                    worst = std::max(worst, std::abs(at(s) - (from + s * (to - from))) / tolerance);
                }
            }
            EXPECT_LE(worst, 1.0 + 1e-6) << name(filter) << ' ' << layer;
            EXPECT_GT(worst, 0.1) << "no promise worth its steps";
            EXPECT_GT(longSteps, 2000);
        }
}

TEST(Importance, NothingBendsInAConstantVolume) {
    const Grid grid = axisAlignedGrid({9, 6, 5}, {1.0, 2.0, 0.5});
    const ImportanceGrid bends = bendsOf(*constantVolume(grid, 0.5));
    EXPECT_EQ(bends.size, glm::ivec3(3, 2, 2));
    for (const glm::vec2 bend : bends.bends) EXPECT_EQ(bend, glm::vec2(0.0f));
    EXPECT_DOUBLE_EQ(renderer::layerMm(grid), 0.5);
    EXPECT_DOUBLE_EQ(renderer::importanceStepMm({0.0f, 0.0f}, Filter::Trilinear, 0.002, 0.5, 0.25, 1.75),
                     1.75);
    EXPECT_DOUBLE_EQ(renderer::longestImportanceStepMm(grid, Filter::Trilinear), 1.75);
}

TEST(Importance, StopsWhenAsked) {
    const VolumePtr volume = hillVolume(axisAlignedGrid({32, 32, 32}));
    const auto stop = [](double, std::string_view) { return false; };
    EXPECT_EQ(renderer::importanceOf(*volume, 0, stop).error().code, ErrorCode::Cancelled);
}

class ImportanceSteps : public GpuTest {};

/// B7.3e: a constant volume is exact with nothing but the longest steps.
TEST_F(ImportanceSteps, AConstantVolumeIsExact) {
    const Grid grid = axisAlignedGrid({4, 40, 4});
    Scene scene = rayScene(constantFunction({0.9, 0.5, 0.1}, 0.05), grid, {0, 1, 0});
    scene.quality.integrator = Integrator::Importance;
    const glm::dvec4 pixel = drawRay(scene, constantVolume(grid, 0.5));
    EXPECT_NEAR(pixel.a, -std::expm1(-0.05 * 40.0), 1e-6);
    EXPECT_NEAR(pixel.r, 0.9 * -std::expm1(-0.05 * 40.0), 1e-6);
}

/// Samples of the rays of a picture, by the rule in double.
double meanSamples(const Scene& scene, const VolumePtr& volume, const ImportanceGrid& bends) {
    const Grid& grid = volume->grid();
    const renderer::Plan plan = renderer::makePlan(scene, {renderer::factsOf(*volume, 0)}).value();
    const glm::dmat4 toIndex = indexFromPatient(grid);
    double count = 0.0;
    for (int y = 0; y < scene.picture.size.y; ++y)
        for (int x = 0; x < scene.picture.size.x; ++x) {
            const PixelRay ray = pixelRay(scene, grid, x, y);
            const double extent = chordMm(grid, ray.originMm, ray.direction, ray.startMm);
            // The entry, from the exit of the ray that runs the other way.
            double enter = ray.startMm;
            for (int axis = 0; axis < 3; ++axis) {
                const double at = transformPoint(toIndex, ray.originMm)[axis];
                const double speed = transformVector(toIndex, ray.direction)[axis];
                enter = std::max(enter, std::min((-0.5 - at) / speed, (grid.size[axis] - 0.5 - at) / speed));
            }
            for (double at = 0.0; at < extent; ++count)
                at += renderer::importanceStepMm(
                    bendAt(bends, transformPoint(toIndex, ray.originMm + (enter + at) * ray.direction)),
                    scene.volumes[0].filter, renderer::importanceTolerance(scene.quality),
                    renderer::layerMm(grid), plan.stepMm, plan.longestStepMm);
        }
    return count / (scene.picture.size.x * scene.picture.size.y);
}

/// B7.3e, B1.4d: against the same rule with uniform steps of the shortest length. A value that is wrong by e
/// changes kappa and kappa c by e times their largest slope s, and a ray of length D by 2 D s e. That is the
/// bound of the largest difference; the root mean square stays below one grey level.
TEST_F(ImportanceSteps, DifferFromUniformStepsWithinTheBoundAndTakeFewer) {
    const VolumePtr volume = hillVolume(axisAlignedGrid({48, 48, 48}));
    const ImportanceGrid bends = bendsOf(*volume);
    for (const Filter filter : {Filter::Trilinear, Filter::TricubicBSpline})
        for (const double tolerance : {4.0, 1.0}) {
            Scene scene =
                sceneOf(colourfulFunction(), orthographicAlong(volume->grid(), kOblique, 60.0), {48, 48});
            scene.volumes[0].filter = filter;
            scene.quality.toleranceGreyLevels = tolerance;
            scene.quality.integrator = Integrator::Preintegrated3D;
            const ImageF uniform = draw(scene, volume);
            scene.quality.integrator = Integrator::Importance;
            const auto found = accuracy::difference(draw(scene, volume), uniform).value();
            const double steepest = (0.5 - 0.02) / 0.35;
            const double bound =
                2.0 * 48.0 * std::sqrt(3.0) * steepest * renderer::importanceTolerance(scene.quality);
            EXPECT_LE(found.maxError, bound) << name(filter) << ' ' << tolerance;
            EXPECT_LE(found.rmse, tolerance / 255.0) << name(filter) << ' ' << tolerance;
            const double samples = meanSamples(scene, volume, bends);
            Scene shortest = scene;
            shortest.quality.toleranceGreyLevels = 1e-9;
            const double uniformSamples = meanSamples(shortest, volume, bends);
            EXPECT_LT(samples, (tolerance > 1.0 ? 0.5 : 0.7) * uniformSamples)
                << name(filter) << ' ' << tolerance;
            const std::string what = std::string(name(filter)) + std::to_string(static_cast<int>(tolerance));
            RecordProperty(what + " max", std::to_string(255.0 * found.maxError));
            RecordProperty(what + " rmse", std::to_string(255.0 * found.rmse));
            RecordProperty(what + " samples",
                           std::to_string(samples) + " of " + std::to_string(uniformSamples));
        }
}

/// A function, a tolerance, a step or a view is no reason to look at the voxels again; another component is.
TEST_F(ImportanceSteps, DependOnTheDataAlone) {
    const VolumePtr volume = hillVolume(axisAlignedGrid({24, 24, 24}));
    Scene scene = sceneOf(colourfulFunction(), orthographicAlong(volume->grid(), kOblique, 30.0), {8, 8});
    scene.quality.integrator = Integrator::Importance;
    const int before = gpu().workCounts().importanceVolumes;
    (void)draw(scene, volume);
    EXPECT_EQ(gpu().workCounts().importanceVolumes, before + 1);
    scene.volumes[0].transferFunction = colourfulFunction(3.0);
    (void)draw(scene, volume);
    scene.quality.toleranceGreyLevels = 0.25;
    (void)draw(scene, volume);
    scene.quality.stepVoxels = 0.25;
    (void)draw(scene, volume);
    scene.camera = perspectiveAlong(volume->grid(), {1, 0, 0}, 3.0);
    (void)draw(scene, volume);
    EXPECT_EQ(gpu().workCounts().importanceVolumes, before + 1);
    (void)draw(scene, hillVolume(axisAlignedGrid({24, 24, 24})));
    EXPECT_EQ(gpu().workCounts().importanceVolumes, before + 2);
}

/// The plan says what there is, where from and how large, for this integrator only; and what it refuses.
TEST(Importance, ThePlanHasItsVolumeForItsIntegratorOnly) {
    const VolumePtr volume = hillVolume(axisAlignedGrid({30, 24, 24}));
    Scene scene = sceneOf(colourfulFunction(), orthographicAlong(volume->grid(), kOblique, 30.0), {8, 8});
    const auto planOf = [&] { return renderer::makePlan(scene, {renderer::factsOf(*volume, 0)}); };
    const auto row = [&] {
        const auto plan = planOf().value();
        for (const auto& resource : plan.resources)
            if (resource.name == "importance volume") return resource.bytes;
        return std::uint64_t{0};
    };
    EXPECT_EQ(row(), 0u);
    scene.quality.integrator = Integrator::Importance;
    EXPECT_EQ(row(), 8u * 6 * 6 * 8);
    EXPECT_EQ(planOf().value().longestStepMm, 3.5);
    for (const Filter filter : {Filter::Nearest, Filter::CatmullRom, Filter::Lanczos3}) {
        scene.volumes[0].filter = filter;
        ASSERT_FALSE(planOf());
        EXPECT_THAT(planOf().error().text(), testing::HasSubstr("tricubic-bspline"));
    }
}

}  // namespace
}  // namespace pellucid::test
