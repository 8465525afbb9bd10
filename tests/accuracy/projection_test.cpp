// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// MIP, MinIP, average, X-ray, slices, surfaces: bounds and closed forms.
#include <gtest/gtest.h>

#include "accuracy/field.h"
#include "tests/accuracy/gpu_fixture.h"

namespace pellucid::test {
namespace {

constexpr glm::dvec3 kOrange(0.9, 0.5, 0.1);
constexpr glm::dvec3 kAlongY(0.0, 1.0, 0.0);
constexpr glm::dvec3 kOblique(0.4, 1.0, -0.3);

class Projection : public GpuTest {};

Scene obliqueScene(const Grid& grid, Mode mode) {
    Scene scene = sceneOf(colourfulFunction(), orthographicAlong(grid, kOblique, 18.0), {24, 24});
    scene.mode = mode;
    return scene;
}

/// Along a voxel row the maximum is the row's largest voxel and the minimum its smallest, exactly: every
/// voxel is sampled.
TEST_F(Projection, ExtremaOfVoxelRowsAreExact) {
    const Grid grid = axisAlignedGrid({6, 9, 5});
    const VolumePtr volume = accuracy::randomVolume(grid, 21);
    Scene scene = sceneOf(colourfulFunction(), orthographicAlong(grid, kAlongY, 5.0), {6, 5});
    scene.volumes.front().filter = Filter::Nearest;
    for (const Mode mode : {Mode::Mip, Mode::MinIp}) {
        scene.mode = mode;
        const ImageF image = draw(scene, volume);
        for (int y = 0; y < 5; ++y)
            for (int x = 0; x < 6; ++x) {
                double expected = volume->physical({x, 0, 4 - y});
                for (int j = 1; j < 9; ++j) {
                    const double v = volume->physical({x, j, 4 - y});
                    expected = mode == Mode::Mip ? std::max(expected, v) : std::min(expected, v);
                }
                EXPECT_NEAR(static_cast<double>(image.at(x, y).r), expected, 3 * kFloatUlp);
                EXPECT_EQ(image.at(x, y).a, 1.0F);
            }
    }
}

/// MinIP <= average <= MIP, MIP within the volume's range, and MIP at least every sample on the same ray.
TEST_F(Projection, BoundsHoldOnEveryRay) {
    const Grid grid = axisAlignedGrid({12, 12, 12});
    const VolumePtr volume = accuracy::randomVolume(grid, 5);
    const ImageF mip = draw(obliqueScene(grid, Mode::Mip), volume);
    const ImageF minip = draw(obliqueScene(grid, Mode::MinIp), volume);
    const ImageF average = draw(obliqueScene(grid, Mode::Average), volume);
    const ImageF slice = draw(obliqueScene(grid, Mode::Slice), volume);
    const ValueRange range = volume->physicalRange();
    // The slice's sample lies between two samples of the MIP ray: half a step of 0.25 mm at a slope of at
    // most 1 per voxel along each axis.
    const double between = 0.25 * (0.4 + 1.0 + 0.3) / glm::length(kOblique);
    int inside = 0;
    for (std::size_t i = 0; i < mip.pixels.size(); ++i) {
        if (mip.pixels[i].a == 0.0F) continue;
        ++inside;
        EXPECT_LE(minip.pixels[i].r, average.pixels[i].r + 1e-6F);
        EXPECT_LE(average.pixels[i].r, mip.pixels[i].r + 1e-6F);
        EXPECT_LE(static_cast<double>(mip.pixels[i].r), range.hi + 1e-6);
        EXPECT_GE(static_cast<double>(minip.pixels[i].r), range.lo - 1e-6);
        if (slice.pixels[i].a > 0.0F) {
            EXPECT_GE(static_cast<double>(mip.pixels[i].r), static_cast<double>(slice.pixels[i].r) - between);
        }
    }
    EXPECT_GT(inside, 200);
}

/// The order along the ray does not matter: seen from behind, the picture is mirrored and otherwise the same.
/// The sampling pattern is counted from the other end; box faces at whole steps make it the same.
TEST_F(Projection, OrderIndependentModesLookTheSameFromBehind) {
    const Grid grid = axisAlignedGrid({10, 12, 8});
    const VolumePtr volume = accuracy::randomVolume(grid, 6);
    for (const Mode mode : {Mode::Mip, Mode::MinIp, Mode::Average, Mode::XRay, Mode::Emission}) {
        Scene scene = sceneOf(colourfulFunction(), orthographicAlong(grid, kAlongY, 9.0), {20, 16});
        scene.mode = mode;
        const ImageF front = draw(scene, volume);
        scene.camera = orthographicAlong(grid, -kAlongY, 9.0);
        const ImageF back = draw(scene, volume);
        ImageF mirrored = back;
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 20; ++x) mirrored.at(x, y) = back.at(19 - x, y);
        // Sums of 24 numbers up to 1 in another order, and positions good to 1e-6 voxels.
        EXPECT_LE(largestDifference(front, mirrored), 1e-5) << name(mode);
    }
}

TEST_F(Projection, AverageOfAConstantIsTheConstant) {
    const Grid grid = axisAlignedGrid({7, 9, 5}, {1.0, 0.4, 2.2});
    const VolumePtr volume = constantVolume(grid, 0.375);
    for (const double step : {0.1, 0.73, 40.0}) {
        for (const Mode mode : {Mode::Average, Mode::Mip, Mode::MinIp, Mode::Slice}) {
            Scene scene = obliqueScene(grid, mode);
            scene.quality.stepVoxels = step;
            const ImageF image = draw(scene, volume);
            for (const glm::vec4& p : image.pixels)
                if (p.a > 0.0F) {
                    EXPECT_NEAR(static_cast<double>(p.r), 0.375, 1e-6) << name(mode) << step;
                }
        }
    }
}

/// The mean counts path, not samples: the shortened last segment has its own weight. The mean over a ramp
/// with constant half voxels at its ends is its middle; the midpoint rule errs by b h^2 / 8 at the bends, and
/// as much over the path.
TEST_F(Projection, AverageOfARampIsItsMiddle) {
    const Grid grid = axisAlignedGrid({3, 9, 3});
    const VolumePtr volume = rampVolume(grid, 0.1, 0.05);
    for (const double step : {0.05, 0.4, 0.7}) {
        Scene scene = rayScene(colourfulFunction(), grid, kAlongY);
        scene.mode = Mode::Average;
        scene.quality.stepMm = step;
        EXPECT_NEAR(drawRay(scene, volume).r, 0.3,
                    2.0 * 0.05 * step * step / 8.0 / 9.0 + 1e-6 + filterError());
    }
}

/// tau = k d over every chord, from both displays, and from optical depths far beyond what exp can hold in
/// float.
TEST_F(Projection, XRayOfAHomogeneousBoxIsBeersLaw) {
    const Grid grid = axisAlignedGrid({9, 7, 5}, {0.7, 1.0, 1.9});
    const VolumePtr volume = constantVolume(grid, 0.5);
    for (const double extinction : {1e-6, 0.1, 1000.0}) {
        Scene scene = obliqueScene(grid, Mode::XRay);
        scene.picture.background = {0.3, 0.6, 0.9};
        scene.volumes.front().transferFunction = constantFunction(kOrange, extinction);
        scene.xray = XRayDisplay::Transmittance;
        const ImageF bright = draw(scene, volume);
        scene.xray = XRayDisplay::Opacity;
        const ImageF dark = draw(scene, volume);
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 24; ++x) {
                const PixelRay ray = pixelRay(scene, grid, x, y);
                const double depth = extinction * chordMm(grid, ray.originMm, ray.direction, ray.startMm);
                EXPECT_NEAR(static_cast<double>(bright.at(x, y).g), std::exp(-depth), 1e-5);
                EXPECT_NEAR(static_cast<double>(dark.at(x, y).b), -std::expm1(-depth), 1e-5);
                // Faint media keep their relative precision (V14: 0.2 % of the depth).
                if (extinction == 1e-6 && depth > 0.0) {
                    EXPECT_NEAR(static_cast<double>(dark.at(x, y).b) / depth, 1.0, 2e-3);
                }
            }
    }
}

/// V14: the line integral of a phantom against exact integration, within 0.5 % of the optical depth.
TEST_F(Projection, XRayLineIntegralOfAPhantom) {
    const Grid grid = axisAlignedGrid({24, 24, 24});
    const VolumePtr volume = accuracy::sampledVolume(
        grid, VoxelType::UInt16,
        [](glm::ivec3 i) {
            return 60000.0 * std::exp(-glm::dot(glm::dvec3(i) - 11.5, glm::dvec3(i) - 11.5) / 50.0);
        },
        {1.0 / 65535.0, 0.0, ""});
    Scene scene = obliqueScene(grid, Mode::XRay);
    scene.xray = XRayDisplay::Transmittance;
    scene.volumes.front().transferFunction = linearExtinction(kOrange, 0.3);
    const ImageF image = draw(scene, volume);
    const accuracy::Field field(*volume, 0, Filter::Trilinear);
    const glm::dmat4 toIndex = indexFromPatient(grid);
    for (int y = 0; y < 24; y += 5)
        for (int x = 0; x < 24; x += 5) {
            const PixelRay ray = pixelRay(scene, grid, x, y);
            double depth = 0.0;
            for (double t = 0.005; t < 8.0 * radiusMm(grid); t += 0.01) {
                const glm::dvec3 p = transformPoint(toIndex, ray.originMm + t * ray.direction);
                if (glm::all(glm::greaterThan(p, glm::dvec3(-0.5))) &&
                    glm::all(glm::lessThan(p, glm::dvec3(23.5))))
                    depth += 0.01 * 0.3 * field.value(field.cellOf(p), p);
            }
            EXPECT_NEAR(-std::log(static_cast<double>(image.at(x, y).r)), depth, 0.005 * depth + 1e-5);
        }
}

/// B3.3d: what comes out of a texture of odd size is what went in: slices through voxel centres, window =
/// identity.
TEST_F(Projection, SlicesShowStoredValuesBitForBit) {
    const Grid grid = axisAlignedGrid({3, 5, 7});
    struct Case {
        VoxelType type;
        double lo, hi;
    };
    for (const Case& c : {Case{VoxelType::UInt8, 0, 255}, Case{VoxelType::Int8, -128, 127},
                          Case{VoxelType::Int16, -32768, 32767}, Case{VoxelType::UInt16, 0, 65535},
                          Case{VoxelType::Float32, -1000, 3095}}) {
        const VolumePtr volume = accuracy::sampledVolume(grid, c.type, [&](glm::ivec3 i) {
            return c.lo + std::floor((c.hi - c.lo) * (i.x + 3 * i.y + 15 * i.z) / 104.0);
        });
        Scene scene = sceneOf(colourfulFunction(), orthographicAlong(grid, kAlongY, 7.0), {3, 7});
        scene.mode = Mode::Slice;
        scene.volumes.front().window = Window{(c.lo + c.hi) / 2.0, c.hi - c.lo};
        for (const Filter filter : {Filter::Nearest, Filter::Trilinear}) {
            scene.volumes.front().filter = filter;
            for (int j = 0; j < 5; ++j) {
                scene.camera.pose->target.y = j;
                const ImageF image = draw(scene, volume);
                for (int y = 0; y < 7; ++y)
                    for (int x = 0; x < 3; ++x) {
                        const double stored = c.lo + static_cast<double>(image.at(x, y).r) * (c.hi - c.lo);
                        EXPECT_EQ(std::lround(stored), std::lround(volume->stored({x, j, 6 - y})))
                            << name(c.type) << name(filter);
                    }
            }
        }
    }
}

/// On a ramp along the ray every place is known: a point light at 45 degrees to the hit gives n.l = cos 45.
/// The hit is refined to 2^-20 steps; the rest is float.
TEST_F(Projection, SurfacesLieWhereTheFieldSays) {
    const Grid grid = axisAlignedGrid({3, 9, 3});
    const VolumePtr volume = rampVolume(grid, 0.0, 0.125);
    const TransferFunction1D function{"", "", {{0.0, kOrange, 0.0}, {1.0, kOrange, 1.0}}};
    Light light;
    light.kind = LightKind::Point;
    light.positionMm = glm::dvec3(1.0, 3.44, 1.0) + glm::dvec3(2.0, -2.0, 0.0);
    for (const Mode mode : {Mode::Isosurface, Mode::FirstHit}) {
        for (const double step : {0.1, 0.7, 3.0, 30.0}) {
            Scene scene = rayScene(function, grid, kAlongY);
            scene.material = {0.0, 1.0, 0.0, 1.0};
            scene.volumes.front().isovalue = 0.43;
            scene.hitOpacity = -std::expm1(-0.43);
            scene.lights = std::vector<Light>{light};
            scene.mode = mode;
            scene.quality.stepMm = step;
            const glm::dvec4 pixel = drawRay(scene, volume);
            EXPECT_EQ(pixel.a, 1.0);
            // d(cos)/d(depth) = 1 / (4 sqrt 2) per mm: 1e-5 allows the surface 6e-5 mm.
            for (int channel = 0; channel < 3; ++channel)
                EXPECT_NEAR(pixel[channel], kOrange[channel] * std::sqrt(0.5), 1e-5 + filterError())
                    << name(mode) << step;
        }
    }
}

TEST_F(Projection, RaysThatMissShowTheBackground) {
    const Grid grid = axisAlignedGrid({4, 4, 4});
    const VolumePtr volume = accuracy::randomVolume(grid, 2);
    for (const Mode mode : allModes()) {
        Scene scene = sceneOf(colourfulFunction(), orthographicAlong(grid, kAlongY, 40.0), {9, 9});
        scene.mode = mode;
        scene.picture.background = {0.25, 0.5, 0.75};
        const ImageF image = draw(scene, volume);
        if (mode == Mode::XRay) {
            EXPECT_EQ(image.at(0, 0), glm::vec4(0, 0, 0, 1));
            continue;
        }
        EXPECT_NEAR(static_cast<double>(image.at(0, 0).r), 0.25, 1e-6) << name(mode);
        EXPECT_NEAR(static_cast<double>(image.at(0, 0).b), 0.75, 1e-6) << name(mode);
        EXPECT_EQ(image.at(0, 0).a, 0.0F) << name(mode);
        scene.picture.transparent = true;
        EXPECT_EQ(draw(scene, volume).at(0, 0), glm::vec4(0.0F)) << name(mode);
    }
}

}  // namespace
}  // namespace pellucid::test
