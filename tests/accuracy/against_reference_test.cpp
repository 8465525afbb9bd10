// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// The renderer against independent double-precision code: once on the very same samples, once against the
// converged reference picture, for every mode, filter, projection and light.
#include <gtest/gtest.h>

#include "accuracy/field.h"
#include "accuracy/metrics.h"
#include "accuracy/reference.h"
#include "tests/accuracy/gpu_fixture.h"

namespace pellucid::test {
namespace {

constexpr glm::dvec3 kOblique(0.4, 1.0, -0.3);

class GpuAgainstReference : public GpuTest {};

VolumePtr smoothData() {
    return accuracy::sampledVolume(axisAlignedGrid({32, 32, 32}, {0.9, 1.0, 1.2}), VoxelType::UInt16,
                                   [](glm::ivec3 i) {
                                       const glm::dvec3 d = (glm::dvec3(i) - 15.5) / 16.0;
                                       const double shells = 0.5 + 0.5 * std::cos(9.0 * glm::length(d));
                                       return 60000.0 * shells * std::exp(-2.0 * glm::dot(d, d));
                                   },
                                   {1.0 / 65535.0, 0.0, ""});
}

VolumePtr randomData() {
    return accuracy::randomVolume(axisAlignedGrid({32, 32, 32}), 1);
}

/// Two hidden sides and a highlight.
std::vector<Light> threeLights() {
    Light side;
    side.kind = LightKind::Directional;
    side.directionMm = {1.0, 0.3, -0.4};
    side.color = {1.0, 0.7, 0.5};
    side.intensity = 0.5;
    Light point;
    point.kind = LightKind::Point;
    point.positionMm = {60.0, -40.0, 50.0};
    point.intensity = 0.4;
    return {Light{}, side, point};
}

/// The samples of the midpoint rule composited back to front, in double (Engel et al. 2006, eq. 1.15): the
/// renderer goes front to back in float on its own code path.
glm::dvec4 backToFront(const Scene& scene, const Volume& volume, const accuracy::Field& field, int x, int y) {
    const Grid& grid = volume.grid();
    const PixelRay ray = pixelRay(scene, grid, x, y);
    const glm::dmat4 toIndex = indexFromPatient(grid);
    const double chord = chordMm(grid, ray.originMm, ray.direction, ray.startMm);
    double enter = ray.startMm;
    for (int axis = 0; axis < 3; ++axis) {
        const double at = transformPoint(toIndex, ray.originMm)[axis];
        const double speed = transformVector(toIndex, ray.direction)[axis];
        enter = std::max(enter, std::min((-0.5 - at) / speed, (grid.size[axis] - 0.5 - at) / speed));
    }
    const double step = stepMm(scene.quality, grid);
    glm::dvec3 color = scene.picture.background;
    double transmittance = 1.0;
    for (int i = static_cast<int>(std::ceil(chord / step)) - 1; i >= 0; --i) {
        const double length = std::min(step, chord - i * step);
        const glm::dvec3 p =
            transformPoint(toIndex, ray.originMm + (enter + i * step + 0.5 * length) * ray.direction);
        const OpticalSample sample =
            evaluate(*scene.volumes.front().transferFunction, field.value(field.cellOf(p), p));
        const double alpha =
            -std::expm1(-sample.extinction * scene.densityScale / *scene.unitLengthMm * length);
        color = (1.0 - alpha) * color + alpha * sample.color;
        transmittance *= 1.0 - alpha;
    }
    return {color, 1.0 - transmittance};
}

/// Same samples, same picture. Positions are good to some 1e-6 of a voxel at slopes up to 2 a voxel; the
/// table adds its stated error to the samples next to a bend only. Nearest-filter samples that fall on a
/// voxel border within the rounding may take the other voxel: one segment's weight, in few pixels.
TEST_F(GpuAgainstReference, SameSamplesBackToFrontInDouble) {
    for (const VolumePtr& volume : {smoothData(), randomData()}) {
        for (const Filter filter : allFilters()) {
            for (const bool perspective : {false, true}) {
                Scene scene = sceneOf(colourfulFunction(2.0),
                                      perspective ? perspectiveAlong(volume->grid(), kOblique, 3.5)
                                                  : orthographicAlong(volume->grid(), kOblique, 40.0),
                                      {32, 32});
                scene.volumes.front().filter = filter;
                scene.picture.background = {0.3, 0.1, 0.5};
                const renderer::Frame frame = frameOf(scene, volume);
                const accuracy::Field field(*volume, 0, filter);
                ImageF expected = frame.image;
                for (int y = 0; y < 32; ++y)
                    for (int x = 0; x < 32; ++x)
                        expected.at(x, y) = glm::vec4(backToFront(scene, *volume, field, x, y));
                const double bound = 5e-5 + 2.0 * frame.plan.table.worstError + filterError();
                EXPECT_LE(shareBeyond(frame.image, expected, bound), filter == Filter::Nearest ? 0.01 : 0.0)
                    << name(filter) << " perspective " << perspective << " table "
                    << frame.plan.table.worstError << " worst " << largestDifference(frame.image, expected);
            }
        }
    }
}

/// A step, in voxels, at which the renderer's own error is below 1/255 on 32 random voxels a side, values in
/// [0, 1] and an extinction of up to 1 per mm and unit of value (rays of some 50 cells, slopes of up to 1 a
/// voxel).
double fineStep(Mode mode, Filter filter, bool lit) {
    // Jumps at voxel borders: half a step of the wrong voxel each, so 50 * h / 2 in the worst case; the
    // emission is not dimmed and needs it. Surfaces take one turn of a loop a sample and lit rays three, and
    // llvmpipe ends loops after 65535 turns.
    const bool surface = mode == Mode::FirstHit || mode == Mode::Isosurface;
    if (filter == Filter::Nearest) return surface ? 1.0 / 500.0 : lit ? 1.0 / 320.0 : 1.0 / 1024.0;
    // A peak between two samples is missed by at most h / 2 at the slope beside it.
    if (mode == Mode::Mip || mode == Mode::MinIp) return 1.0 / 512.0;
    // A surface thinner than a step is missed.
    if (surface) return 1.0 / 64.0;
    // A shade that jumps: as jumps above, times T and in far fewer places.
    if (lit) return 1.0 / 32.0;
    // Bends at cell borders and control points: h^2 / 8 times the change of slope each.
    return 1.0 / 16.0;
}

/// Edges, where a pixel may fall to either side: of surfaces, of shades where the normal turns, of
/// nearest-filter voxels seen at a grazing angle. A lit surface of nearest-filter voxels lies on a voxel's
/// face, and which neighbours its differences take there is decided by the rounding of the hit.
double allowedShare(Mode mode, Filter filter, bool lit) {
    const bool surface = mode == Mode::Isosurface || mode == Mode::FirstHit;
    // Lit nearest-filter rays have three times the step of unlit ones (the driver's loop limit), so the jumps
    // at their voxel faces, first order in the step, leave 1/255 in one pixel of sixteen.
    if (filter == Filter::Nearest && lit) return 0.1;
    if (surface) return 0.03;
    return filter == Filter::Nearest || lit ? 0.01 : 0.0;
}

/// Within 1/255 of the converged reference, every mode, filter, projection and light, on smooth and on random
/// data.
TEST_F(GpuAgainstReference, EveryModeFilterProjectionAndLight) {
    for (const VolumePtr& volume : {smoothData(), randomData()}) {
        for (const Mode mode : allModes()) {
            for (const Filter filter : allFilters()) {
                for (const bool lit : {false, true}) {
                    if (lit && !usesLights(mode)) continue;
                    // Each mode sees both projections; both with every light would only repeat the ray
                    // set-up.
                    const bool perspective = lit || mode == Mode::Mip || mode == Mode::XRay;
                    Scene scene = sceneOf(colourfulFunction(2.0),
                                          perspective ? perspectiveAlong(volume->grid(), kOblique, 3.5)
                                                      : orthographicAlong(volume->grid(), kOblique, 40.0),
                                          glm::ivec2(filter == Filter::Lanczos3 ? 8 : 24));
                    scene.mode = mode;
                    scene.volumes.front().filter = filter;
                    scene.hitOpacity = 0.2;
                    scene.picture.background = {0.3, 0.1, 0.5};
                    if (lit) scene.lights = threeLights();
                    const auto reference = accuracy::referencePicture(scene, {volume}, {2e-4, 4, {}});
                    ASSERT_TRUE(reference) << reference.error().text();
                    scene.quality.stepVoxels = fineStep(mode, filter, lit);
                    const ImageF image = draw(scene, volume);
                    const double allowed = allowedShare(mode, filter, lit);
                    EXPECT_LE(shareBeyond(image, reference->image, 1.0 / 255.0), allowed)
                        << name(volume->type()) << ' ' << name(mode) << ' ' << name(filter) << " lit " << lit
                        << " worst " << largestDifference(image, reference->image) << " reference good to "
                        << reference->reachedBound;
                }
            }
        }
    }
}

/// Second order: halving the step quarters the error, on a smooth field with a smooth transfer function.
/// (Observed order, after Etiene et al., "Verifying volume rendering using discretization error analysis",
/// IEEE TVCG 20(1), 2014.)
TEST_F(GpuAgainstReference, TheMidpointRuleConvergesWithOrderTwo) {
    const VolumePtr volume =
        accuracy::sampledVolume(axisAlignedGrid({24, 24, 24}), VoxelType::Float32, [](glm::ivec3 i) {
            const glm::dvec3 d = glm::dvec3(i) - 11.5;
            return std::exp(-glm::dot(d, d) / 30.0);
        });
    Scene scene = sceneOf(linearExtinction({0.9, 0.5, 0.1}, 0.5),
                          orthographicAlong(volume->grid(), kOblique, 16.0), {16, 16});
    scene.volumes.front().filter = Filter::TricubicBSpline;
    scene.picture.background = {1.0, 1.0, 1.0};
    const auto reference = accuracy::referencePicture(scene, {volume}, {1e-8, 4, {}});
    ASSERT_TRUE(reference);
    double before = 0.0;
    for (const double step : {4.0, 2.0, 1.0}) {
        scene.quality.stepVoxels = step;
        const double error = accuracy::difference(draw(scene, volume), reference->image)->rmse;
        if (before > 0.0) {
            EXPECT_GE(std::log2(before / error), 1.7) << "step " << step << " error " << error;
        }
        before = error;
    }
    EXPECT_LT(before, 1e-3);
}

/// Transparent pictures: associated colour without the background, in both spaces.
TEST_F(GpuAgainstReference, TransparentAndLinearPictures) {
    const VolumePtr volume = smoothData();
    for (const bool transparent : {false, true}) {
        for (const CompositingSpace space : {CompositingSpace::Display, CompositingSpace::Linear}) {
            for (const Mode mode : allModes()) {
                Scene scene = sceneOf(colourfulFunction(2.0),
                                      orthographicAlong(volume->grid(), kOblique, 60.0), {24, 24});
                scene.mode = mode;
                scene.space = space;
                scene.picture.transparent = transparent;
                scene.picture.background = {0.3, 0.1, 0.5};
                scene.quality.stepVoxels = 1.0 / 16.0;
                const auto reference = accuracy::referencePicture(scene, {volume}, {1e-4, 3, {}});
                ASSERT_TRUE(reference);
                EXPECT_LE(shareBeyond(draw(scene, volume), reference->image, 1.0 / 255.0),
                          mode == Mode::Isosurface || mode == Mode::FirstHit ? 0.03 : 0.0)
                    << name(mode) << " transparent " << transparent << " linear "
                    << (space == CompositingSpace::Linear);
            }
        }
    }
}

/// Voxels of every type, with a mapping, with NaN and infinity among them, in several components.
TEST_F(GpuAgainstReference, EveryVoxelTypeAndComponent) {
    const Grid grid = axisAlignedGrid({9, 7, 5});
    for (const VoxelType type :
         {VoxelType::Int8, VoxelType::UInt8, VoxelType::Int16, VoxelType::UInt16, VoxelType::Int32,
          VoxelType::UInt32, VoxelType::Float32, VoxelType::Float64}) {
        const bool isFloat = type == VoxelType::Float32 || type == VoxelType::Float64;
        const double nan = std::numeric_limits<double>::quiet_NaN();
        const VolumePtr volume =
            accuracy::sampledVolume(grid, type,
                                    [&](glm::ivec3 i) {
                                        if (isFloat && i == glm::ivec3(4, 3, 2)) return nan;
                                        return static_cast<double>((i.x * 37 + i.y * 59 + i.z * 83) % 120);
                                    },
                                    {-1.0 / 119.0, 1.0, ""});
        for (const Mode mode : {Mode::Composite, Mode::Average}) {
            Scene scene = sceneOf(colourfulFunction(), orthographicAlong(grid, kOblique, 9.0), {24, 24});
            scene.mode = mode;
            scene.quality.stepVoxels = 1.0 / 16.0;
            const auto reference = accuracy::referencePicture(scene, {volume}, {1e-4, 3, {}});
            ASSERT_TRUE(reference);
            EXPECT_LE(largestDifference(draw(scene, volume), reference->image), 1.0 / 255.0)
                << name(type) << ' ' << name(mode);
        }
    }
    std::vector<std::byte> voxels;
    for (int n = 0; n < 9 * 7 * 5; ++n)
        for (int component = 0; component < 3; ++component)
            voxels.push_back(static_cast<std::byte>((n * 31 + component * 90 + n * component * 7) % 251));
    const auto colours = Volume::make(grid, VoxelType::UInt8, 3, std::move(voxels), {1.0 / 255.0, 0.0, ""});
    ASSERT_TRUE(colours);
    for (int component = 0; component < 3; ++component) {
        Scene scene = sceneOf(colourfulFunction(), orthographicAlong(grid, kOblique, 9.0), {24, 24});
        scene.volumes.front().component = component;
        scene.quality.stepVoxels = 1.0 / 16.0;
        const auto reference = accuracy::referencePicture(scene, {*colours}, {1e-4, 3, {}});
        ASSERT_TRUE(reference);
        EXPECT_LE(largestDifference(draw(scene, *colours), reference->image), 1.0 / 255.0) << component;
    }
}

}  // namespace
}  // namespace pellucid::test
