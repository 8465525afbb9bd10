// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Grids of every shape, mirrored scans, viewpoints inside the volume, windows of different size.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/accuracy/gpu_fixture.h"

namespace pellucid::test {
namespace {

constexpr glm::dvec3 kOrange(0.9, 0.5, 0.1);
constexpr glm::dvec3 kAlongY(0.0, 1.0, 0.0);
constexpr glm::dvec3 kOblique(0.4, 1.0, -0.3);

class Geometry : public GpuTest {};

constexpr double kBallMm = 14.0;

/// (1 - r^2 / R^2)^3 within R = kBallMm of the origin, 0 outside: twice continuously differentiable, second
/// derivatives along any direction within +-6 / R^2.
double ball(glm::dvec3 p) {
    const double s = 1.0 - glm::dot(p, p) / (kBallMm * kBallMm);
    return s > 0.0 ? s * s * s : 0.0;
}

/// The ball sampled on a grid that is centred on the origin.
VolumePtr ballOn(const glm::dmat3& axes) {
    const glm::dmat3 inverse = glm::inverse(axes);
    glm::ivec3 size(0);
    for (int axis = 0; axis < 3; ++axis) {
        const glm::dvec3 row(inverse[0][axis], inverse[1][axis], inverse[2][axis]);
        size[axis] = 2 * static_cast<int>(std::ceil(kBallMm * glm::length(row))) + 3;
    }
    Grid grid{size, glm::dmat4(axes)};
    grid.patientFromIndex[3] = glm::dvec4(-(axes * (glm::dvec3(size - 1) / 2.0)), 1.0);
    return accuracy::sampledVolume(grid, VoxelType::Float32, [&](glm::ivec3 i) {
        return ball(transformPoint(grid.patientFromIndex, i));
    });
}

/// Trilinear interpolation errs by at most sum over axes of h^2 / 8 * max |f''|; a ray crosses at most 2 R of
/// it with extinction slope k. `step` adds the midpoint rule's bends: far below.
double opacityError(const glm::dmat3& axes, double slope) {
    double value = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        value += glm::dot(axes[axis], axes[axis]) / 8.0 * 6.0 / (kBallMm * kBallMm);
    return slope * value * 2.0 * kBallMm;
}

Scene ballScene(bool perspective) {
    const Grid frame = axisAlignedGrid({29, 29, 29}, {1, 1, 1}, {-14, -14, -14});
    Scene scene = sceneOf(
        linearExtinction(kOrange, 0.06),
        perspective ? perspectiveAlong(frame, kOblique, 4.0) : orthographicAlong(frame, kOblique, 30.0),
        {32, 32});
    scene.quality.stepMm = 0.2;
    return scene;
}

void expectSamePicture(const ImageF& a, const ImageF& b, double bound) {
    EXPECT_LE(largestDifference(a, b), bound);
    double brightest = 0.0;
    for (const glm::vec4& p : a.pixels) brightest = std::max(brightest, static_cast<double>(p.a));
    EXPECT_GT(brightest, 0.4);  // There is something to see.
}

TEST_F(Geometry, AnisotropicObliqueAndShearedGridsGiveTheIsotropicPicture) {
    const glm::dmat3 isotropic(0.5);
    const glm::dmat3 rotation(glm::rotate(glm::dmat4(1.0), 0.6, glm::dvec3(0.3, 0.5, -0.8)));
    glm::dmat3 shear(0.5);
    shear[2] = {0.2, 0.0, 0.6};  // Gantry tilt: slices shifted along x.
    const std::vector<std::pair<const char*, glm::dmat3>> grids{
        {"anisotropic", glm::dmat3(glm::dvec3(0.4, 0, 0), glm::dvec3(0, 0.5, 0), glm::dvec3(0, 0, 0.9))},
        {"oblique", rotation * glm::dmat3(0.5)},
        {"sheared", shear},
        {"left-handed", glm::dmat3(glm::dvec3(0, 0.5, 0), glm::dvec3(0.5, 0, 0), glm::dvec3(0, 0, 0.5))},
        {"oblique and sheared", rotation * shear}};
    for (const bool perspective : {false, true}) {
        const Scene scene = ballScene(perspective);
        const ImageF expected = draw(scene, ballOn(isotropic));
        for (const auto& [name, axes] : grids) {
            SCOPED_TRACE(name);
            expectSamePicture(
                expected, draw(scene, ballOn(axes)),
                opacityError(isotropic, 0.06) + opacityError(axes, 0.06) + 0.06 * 28.0 * filterError());
        }
    }
}

/// Lit: the gradient is mapped by the transposed inverse. On a field that is linear in the patient frame
/// every grid has the same normal exactly, so the shade is the same wherever the extinction is constant.
TEST_F(Geometry, NormalsAreThoseOfThePatientFrame) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(0.3, -0.8, 0.5));
    glm::dmat3 axes(glm::rotate(glm::dmat4(1.0), 0.6, glm::dvec3(0.3, 0.5, -0.8)));
    axes[0] *= 0.5;
    axes[2] = 1.7 * axes[2] + 0.4 * axes[0];
    Grid grid{{9, 9, 9}, glm::dmat4(axes)};
    const VolumePtr volume = accuracy::sampledVolume(grid, VoxelType::Float32, [&](glm::ivec3 i) {
        return 0.5 + 0.01 * glm::dot(direction, transformPoint(grid.patientFromIndex, i));
    });
    Light side;
    side.kind = LightKind::Directional;
    side.directionMm = {-1.0, 0.4, 0.2};
    for (const Filter filter : allFilters()) {
        // All the light comes back from the first voxels; the voxel layer at the border has halved
        // differences, so look from inside.
        Scene scene = rayScene(constantFunction(kOrange, 50.0), grid, kOblique);
        scene.camera.pose->eye = centreMm(grid) - 0.5 * glm::normalize(kOblique);
        scene.volumes.front().filter = filter;
        scene.material = {0.1, 0.7, 0.2, 12.0};
        scene.lights = std::vector<Light>{side};
        const glm::dvec3 v = -glm::normalize(kOblique);
        glm::dvec3 n = -direction;
        if (glm::dot(n, v) < 0.0) n = -n;
        const glm::dvec3 l = -glm::normalize(side.directionMm);
        const glm::dvec3 h = glm::normalize(l + v);
        ASSERT_GT(glm::dot(n, l), 0.3);
        const glm::dvec3 expected = 0.1 * kOrange + 0.7 * std::max(0.0, glm::dot(n, l)) * kOrange +
                                    0.2 * std::pow(std::max(0.0, glm::dot(n, h)), 12.0);
        const glm::dvec4 pixel = drawRay(scene, volume);
        // Values near 0.5 in float, differences of 0.01: relative 1e-5, times the power's 12.
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(pixel[channel], expected[channel], 2e-4) << name(filter);
    }
}

/// The same voxels on a grid mirrored in x, seen along a direction in the mirror plane: the mirrored picture.
TEST_F(Geometry, AMirroredGridMirrorsThePicture) {
    const Grid grid = axisAlignedGrid({12, 9, 10}, {1.0, 1.3, 0.8});
    Grid mirrored = grid;
    mirrored.patientFromIndex[0] = -grid.patientFromIndex[0];
    mirrored.patientFromIndex[3] = glm::dvec4(2.0 * centreMm(grid).x - grid.patientFromIndex[3].x,
                                              grid.patientFromIndex[3].y, grid.patientFromIndex[3].z, 1.0);
    for (const bool lit : {false, true}) {
        Scene scene =
            sceneOf(colourfulFunction(3.0), perspectiveAlong(grid, {0.0, 1.0, -0.2}, 3.5), {32, 24});
        if (lit) scene.lights = std::vector<Light>{Light{}};
        const ImageF plain = draw(scene, accuracy::randomVolume(grid, 3));
        ImageF expected = plain;
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 32; ++x) expected.at(x, y) = plain.at(31 - x, y);
        const ImageF found = draw(scene, accuracy::randomVolume(mirrored, 3));
        // Positions differ by rounding: 1e-6 voxels times slopes of 1 a voxel, and normals that turn at
        // another sample.
        EXPECT_LE(shareBeyond(found, expected, 1e-4), lit ? 0.01 : 0.0);
        EXPECT_GT(largestDifference(found, plain), 0.05);
    }
}

/// B11.4e: alpha = 1 - exp(-k (exit - start)) with the eye inside the box, in every direction; the near plane
/// moves the start.
TEST_F(Geometry, ViewpointInsideTheVolume) {
    const Grid grid = axisAlignedGrid({20, 20, 20}, {1, 1, 1}, {-9.5, -9.5, -9.5});
    const VolumePtr volume = constantVolume(grid, 0.5);
    for (const double nearMm : {0.0, 1.7}) {
        Scene scene =
            sceneOf(constantFunction(kOrange, 0.05), perspectiveAlong(grid, kOblique, 0.1, 90.0), {24, 24});
        scene.camera.nearMm = nearMm;
        const ImageF image = draw(scene, volume);
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 24; ++x) {
                const PixelRay ray = pixelRay(scene, grid, x, y);
                const double chord = chordMm(grid, ray.originMm, ray.direction, ray.startMm);
                EXPECT_GT(chord, 5.0);
                EXPECT_NEAR(static_cast<double>(image.at(x, y).a), -std::expm1(-0.05 * chord), 1e-5);
            }
    }
}

/// Dolly from outside through the front face and on to beyond the box, 0.01 voxel a frame around the face and
/// the eye's way out: no picture jumps by a grey level, no pixel gets lost.
TEST_F(Geometry, DollyThroughTheVolumeIsContinuous) {
    const Grid grid = axisAlignedGrid({16, 16, 16});
    const VolumePtr volume = accuracy::randomVolume(grid, 9);
    // Extinction at most 0.2 a voxel: 0.01 voxel less path changes alpha by 0.002 at the front and moves the
    // rays' sideways positions by as little again; together below 1/255.
    Scene scene =
        sceneOf(linearExtinction(kOrange, 0.2), perspectiveAlong(grid, kAlongY, 1.0, 60.0), {16, 16});
    // Steps are counted from the start of the ray, so the sampling pattern moves along: fine steps make that
    // small.
    scene.quality.stepMm = 0.05;
    const auto at = [&](double y) {
        scene.camera.pose->eye = {7.5, y, 7.5};
        scene.camera.pose->target = {7.5, y + 10.0, 7.5};
        return draw(scene, volume);
    };
    for (const double from : {-0.55, 7.3, 15.4}) {
        ImageF before = at(from);
        for (int frame = 1; frame <= 12; ++frame) {
            const ImageF now = at(from + 0.01 * frame);
            EXPECT_LE(largestDifference(before, now), 1.0 / 255.0) << from + 0.01 * frame;
            before = now;
        }
    }
}

/// The middle of a picture twice as wide and high, of the same scene at the same scale, is the small picture.
TEST_F(Geometry, WindowSizeDoesNotChangeIdenticalRays) {
    const Grid grid = axisAlignedGrid({16, 16, 16});
    const VolumePtr volume = accuracy::randomVolume(grid, 4);
    for (const bool perspective : {false, true}) {
        Scene scene = sceneOf(colourfulFunction(3.0),
                              perspective ? perspectiveAlong(grid, kOblique, 3.0, 30.0)
                                          : orthographicAlong(grid, kOblique, 20.0),
                              {20, 16});
        scene.lights = std::vector<Light>{Light{}};
        const ImageF small = draw(scene, volume);
        scene.picture.size *= 2;
        scene.camera.pose->heightMm *= 2.0;
        const double half = glm::radians(15.0);
        scene.camera.fovDeg = glm::degrees(2.0 * std::atan(2.0 * std::tan(half)));
        const ImageF large = draw(scene, volume);
        ImageF middle = small;
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 20; ++x) middle.at(x, y) = large.at(x + 10, y + 8);
        // Rounding of the rays only; a normal may turn at another sample in a pixel or two.
        EXPECT_LE(shareBeyond(small, middle, 1e-4), 0.01);
    }
}

/// B7.3a: rays that graze a face of a dense box do not flicker when the camera moves by a millionth.
TEST_F(Geometry, GrazingRaysDoNotFlicker) {
    const Grid grid = axisAlignedGrid({8, 8, 8});
    const VolumePtr volume = constantVolume(grid, 0.5);
    Scene scene = sceneOf(constantFunction(kOrange, 0.3), orthographicAlong(grid, kAlongY, 16.0), {16, 16});
    // Pixel columns lie on integers + 0.5 of the picture, the faces at +-4 mm: move the picture so that a
    // column grazes.
    for (const double graze : {0.5, 0.5 - 1e-3, 0.5 + 1e-3}) {
        scene.camera.pose->eye.x = 3.5 + graze;
        scene.camera.pose->target.x = 3.5 + graze;
        const ImageF before = draw(scene, volume);
        for (const double shift : {1e-6, -1e-6}) {
            scene.camera.pose->eye.x = 3.5 + graze + shift;
            scene.camera.pose->target.x = 3.5 + graze + shift;
            const ImageF after = draw(scene, volume);
            if (graze == 0.5) {
                // On the face itself a ray is in or out; all others must stay, and nothing else may appear.
                EXPECT_LE(shareBeyond(before, after, 1e-5), 2.0 / 16.0);
                for (const glm::vec4& p : after.pixels)
                    EXPECT_LE(std::min(std::abs(static_cast<double>(p.a)),
                                       std::abs(static_cast<double>(p.a) + std::expm1(-2.4))),
                              1e-5);
            } else {
                EXPECT_LE(largestDifference(before, after), 1e-5);
            }
        }
    }
}

/// A scan 10 m from the origin looks as one at the origin; the eye itself is stored to 1e-12 mm there.
TEST_F(Geometry, AFarOriginChangesNothing) {
    const Grid near = axisAlignedGrid({16, 16, 16}, {0.5, 0.5, 0.5});
    const Grid far = axisAlignedGrid({16, 16, 16}, {0.5, 0.5, 0.5}, {1e4, -1e4, 1e4});
    const auto at = [&](const Grid& grid) {
        return draw(sceneOf(colourfulFunction(9.0), perspectiveAlong(grid, kOblique, 3.5), {24, 24}),
                    accuracy::randomVolume(grid, 3));
    };
    EXPECT_LE(largestDifference(at(near), at(far)), 1e-4);
}

}  // namespace
}  // namespace pellucid::test
