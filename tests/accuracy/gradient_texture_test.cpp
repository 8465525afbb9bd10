// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Gradients from a texture of central differences are those on the fly: interpolation and differences of one
// voxel are linear and change places (docs/equations.md).
#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "accuracy/metrics.h"
#include "accuracy/reference.h"
#include "scene/names.h"
#include "tests/accuracy/estimate_judge.h"

namespace pellucid::test {
namespace {

constexpr glm::dvec3 kOblique(0.4, 1.0, -0.3);

/// A slope in all directions and waves of some ten voxels: no gradient vanishes, so that no normal turns by
/// rounding alone. Values in [0, 1], `levels` stored ones.
VolumePtr slopeVolume(const Grid& grid, VoxelType type, double levels) {
    const glm::dvec3 size(grid.size);
    return accuracy::sampledVolume(
        grid, type,
        [=](glm::ivec3 i) {
            const glm::dvec3 p = (glm::dvec3(i) + 0.5) / size;
            const double slope = 0.3 * p.x + 0.25 * p.y + 0.35 * p.z;
            return levels *
                   (slope + 0.03 * (std::sin(9.0 * p.y) + std::sin(7.0 * p.z) + std::cos(8.0 * p.x)) / 3.0);
        },
        {1.0 / levels, 0.0, ""});
}

Light sideLight() {
    Light side;
    side.kind = LightKind::Directional;
    side.directionMm = {1.0, 0.3, -0.4};
    side.color = {1.0, 0.7, 0.5};
    return side;
}

class GradientTexture : public GpuTest {
protected:
    /// Difference of the pictures with either, in grey levels.
    static accuracy::ImageDifference apart(Scene scene, const VolumePtr& volume, glm::ivec2 size = {48, 40}) {
        scene.picture.size = size;
        scene.quality.gradients = Gradients::OnTheFly;
        const ImageF onTheFly = draw(scene, volume);
        scene.quality.gradients = Gradients::Texture;
        const renderer::Frame frame = frameOf(scene, volume);
        EXPECT_EQ(frame.plan.features.gradients, renderer::GradientSource::Texture);
        return accuracy::difference(onTheFly, frame.image).value();
    }

    static Grid sheared(glm::ivec3 size) {
        Grid grid = axisAlignedGrid(size, {1.0, 0.6, 1.9}, {20.0, -7.0, 3.0});
        glm::dmat4 shear(1.0);
        shear[2][0] = 0.25;
        grid.patientFromIndex =
            glm::rotate(glm::dmat4(1.0), 0.5, glm::dvec3(0.2, 1.0, -0.4)) * shear * grid.patientFromIndex;
        return grid;
    }
};

/// Noise has gradients everywhere, at the borders too, and of all directions. A difference on the fly is one
/// of two interpolated values, each rounded to a few 6e-8 of the range; half of them are above a tenth of it,
/// so a normal is good to 1e-6 and a shade as well. Samples with a gradient near zero are worse in
/// proportion; among some 1e5 samples the smallest is about 1/50, and a ray's colour is a mean of several: a
/// hundredth of a grey level is far above that and far below what shows.
TEST_F(GradientTexture, GivesThePictureOfGradientsOnTheFly) {
    const VolumePtr noise = accuracy::randomVolume(sheared({13, 9, 11}), 3);
    struct Stored {
        VoxelType type;
        double scale, offset;
    };
    for (const auto& [type, scale, offset] :
         {Stored{VoxelType::Float32, 1.0, 0.0}, Stored{VoxelType::UInt8, 255.0, 0.0},
          Stored{VoxelType::Int16, 2000.0, -1000.0}, Stored{VoxelType::UInt16, 30000.0, 0.0}}) {
        const VolumePtr volume = accuracy::sampledVolume(
            noise->grid(), type, [&](glm::ivec3 i) { return offset + scale * noise->physical(i); });
        for (const Integrator integrator : {Integrator::Exponential, Integrator::Simpson}) {
            Scene scene = completed(sceneIn(Mode::Composite, true), {volume});
            scene.quality.integrator = integrator;
            EXPECT_LT(255.0 * apart(scene, volume).maxError, 0.01) << name(type) << ' ' << name(integrator);
        }
    }
}

/// Data over more than 32767 stored values have differences rounded to half a texel of 65534 (the plan says
/// so): 7.6e-6 of the range a voxel, which turns the gradient of a slope of 1/100 of the range a voxel by
/// less than a thousandth, and so the shade. Only beside the two voxels that make the range wide does the
/// slope vanish somewhere, so the mean is judged.
TEST_F(GradientTexture, KeepsTheDirectionOfSmallGradientsInAWideRange) {
    const VolumePtr volume =
        accuracy::sampledVolume(sheared({20, 18, 16}), VoxelType::UInt16, [](glm::ivec3 i) {
            return 32768.0 + 655.0 * (i.x - 9.5) + 300.0 * std::sin(0.4 * i.y) +
                   (i == glm::ivec3(0) ? -26000.0 : 0.0) + (i == glm::ivec3(19, 17, 15) ? 26000.0 : 0.0);
        });
    const Scene scene = completed(sceneIn(Mode::Composite, true), {volume});
    EXPECT_LT(255.0 * apart(scene, volume).rmse, 0.255);
}

TEST_F(GradientTexture, IsMadeForLitPicturesOnly) {
    const VolumePtr volume = accuracy::ctLikeShells(24);
    EXPECT_EQ(frameOf(completed(sceneIn(Mode::Composite, false), {volume}), volume).plan.features.gradients,
              renderer::GradientSource::OnTheFly);
    EXPECT_EQ(frameOf(completed(sceneIn(Mode::Composite, true), {volume}), volume).plan.features.gradients,
              renderer::GradientSource::Texture);
}

/// Values are floats up to 1, so the differences that are made on the fly are good to 2 ulp of 1 (1.2e-7) a
/// component; the least gradient is 0.3 / 25 - 0.03 * 9 / 3 / 25 = 0.008 a voxel, which turns normals by
/// 3e-5, in colours 3e-5 * (0.7 + 0.2 * 12) = 1e-4, where all samples erred alike. Hardware whose filter
/// weights are 8 bits makes differences of 0.05 a voxel wrong by 3/512 of that, a sixth of the gradient.
TEST_F(GradientTexture, IsTheSameWithEveryIntegratorInEveryView) {
    const Grid grid = sheared({25, 22, 19});
    const std::array volumes{slopeVolume(grid, VoxelType::Float32, 1.0),
                             slopeVolume(grid, VoxelType::Int16, 4000.0),
                             slopeVolume(grid, VoxelType::UInt8, 255.0)};
    unsigned turn = 0;
    const auto check = [&](Integrator integrator) {
        const VolumePtr& volume = volumes[turn % 3];
        // Half a voxel at the border, where differences go to nothing, is seen from inside and outside.
        Scene scene = sceneOf(colourfulFunction(2.0),
                              turn % 2 == 0 ? perspectiveAlong(grid, kOblique, turn % 4 == 0 ? 0.2 : 3.0)
                                            : orthographicAlong(grid, -kOblique, 30.0),
                              {24, 20});
        scene.lights = std::vector<Light>{Light{}, sideLight()};
        scene.material = {0.1, 0.7, 0.2, 12.0};
        scene.quality.integrator = integrator;
        scene.quality.jitter = turn % 5 < 2;
        scene.quality.stepVoxels = turn % 2 == 1 ? 1.3 : 0.4;
        // Bytes are steps: gradients of 1/255 of two voxels, and zero ones in places. Adaptive steps may be
        // taken otherwise for a rounding, within the tolerance of half a grey level either way.
        const double bound = integrator == Integrator::Adaptive   ? 1.0 / 255.0
                             : volume->type() == VoxelType::UInt8 ? 4e-4
                                                                  : 1e-4;
        EXPECT_LE(apart(scene, volume, {24, 20}).maxError, bound + filterError())
            << name(integrator) << ' ' << turn;
        ++turn;
    };
    for (const auto& integrator : enumNames<Integrator>()) check(integrator.value);
    for (int i = 0; i < 6; ++i) check(Integrator::Exponential);
}

/// Where the whole field is fetched at once, all that goes with it: early end of rays, skipping, light-linear
/// colours, the other classification, and modes that are lit once a ray.
TEST_F(GradientTexture, IsTheSameInOtherScenes) {
    const Grid grid = sheared({25, 22, 19});
    const VolumePtr volume = slopeVolume(grid, VoxelType::Float32, 1.0);
    Scene scene = sceneOf(colourfulFunction(2.0), perspectiveAlong(grid, kOblique, 3.0), {48, 40});
    scene.lights = std::vector<Light>{sideLight()};
    scene.volumes[0].transferFunction->points.front().value = 0.3;
    EXPECT_LE(apart(scene, volume, {24, 20}).maxError, 1e-4 + filterError());
    scene.space = CompositingSpace::Linear;
    EXPECT_LE(apart(scene, volume, {24, 20}).maxError, 1e-4 + filterError());
    scene.volumes[0].classification = Classification::Pre;
    EXPECT_LE(apart(scene, volume, {24, 20}).maxError, 1e-4 + filterError());
    scene.volumes[0].classification = Classification::Post;
    for (const Mode mode : {Mode::FirstHit, Mode::Isosurface}) {
        scene.mode = mode;
        EXPECT_LE(apart(scene, volume, {24, 20}).maxError, 1e-4 + filterError()) << name(mode);
    }
    scene.mode = Mode::Composite;
    // Either way a ray ends within the bound.
    scene.quality.earlyTermination = 1.0 / 64.0;
    EXPECT_LE(apart(scene, volume, {24, 20}).maxError, 1.5 / 64.0);
}

/// Against independent double-precision code. The step's own error is the same both ways; the texture of a
/// range of 65535 values, with its rounded differences, must not be farther away by more than its bound makes
/// of the least gradient (7.6e-6 / 0.008 rad, times 0.7 + 0.2 * 12).
TEST_F(GradientTexture, IsAsCloseToTheReference) {
    const Grid grid = sheared({25, 22, 19});
    for (const auto& [type, levels] :
         {std::pair(VoxelType::UInt16, 65535.0), std::pair(VoxelType::Int16, 4000.0)}) {
        const VolumePtr volume = slopeVolume(grid, type, levels);
        Scene scene = sceneOf(colourfulFunction(2.0), orthographicAlong(grid, kOblique, 30.0), {24, 20});
        scene.lights = std::vector<Light>{Light{}, sideLight()};
        scene.material = {0.1, 0.7, 0.2, 12.0};
        scene.quality.stepVoxels = 0.05;
        const auto exact = accuracy::referencePicture(scene, {volume}, {1e-4, 8, {}, 0.0});
        ASSERT_TRUE(exact) << exact.error().text();
        scene.quality.gradients = Gradients::OnTheFly;
        const double onTheFly = largestDifference(draw(scene, volume), exact->image);
        scene.quality.gradients = Gradients::Texture;
        const double texture = largestDifference(draw(scene, volume), exact->image);
        EXPECT_LE(texture, onTheFly + 3.1 * 7.6e-6 / 0.008 + 1e-4) << name(type);
        EXPECT_LE(texture, 2e-3 + filterError()) << name(type);
    }
}

/// A large volume's texture is made by and by where pictures are wanted at once, and one that waits has it.
TEST_F(GradientTexture, PicturesInPassingDoNotWaitForIt) {
    // 2.6 million texels: three slabs, one a picture.
    const VolumePtr volume = slopeVolume(axisAlignedGrid({128, 130, 150}), VoxelType::UInt8, 255.0);
    Scene scene = sceneOf(colourfulFunction(), orthographicAlong(volume->grid(), kOblique, 200.0), {8, 8});
    scene.lights = std::vector<Light>{Light{}};
    renderer::RenderOptions passing;
    passing.allowPreview = true;
    passing.gradientMs = 0.0;
    const int before = gpu().workCounts().fieldTextures;
    std::vector<renderer::GradientSource> sources;
    std::vector<ImageF> images;
    for (int i = 0; i < 5; ++i) {
        auto frame = frameOf(scene, volume, passing);
        sources.push_back(frame.plan.features.gradients);
        images.push_back(std::move(frame.image));
    }
    EXPECT_EQ(sources.front(), renderer::GradientSource::OnTheFly);
    EXPECT_EQ(sources.back(), renderer::GradientSource::Texture);
    EXPECT_EQ(gpu().workCounts().fieldTextures, before + 1);
    // Bytes, as above.
    EXPECT_LE(largestDifference(images.front(), images.back()), 4e-3 + filterError());
    const VolumePtr other = slopeVolume(volume->grid(), VoxelType::UInt8, 254.0);
    EXPECT_EQ(frameOf(scene, other).plan.features.gradients, renderer::GradientSource::Texture);
}

}  // namespace
}  // namespace pellucid::test
