// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Gradients from a texture of central differences are those on the fly: interpolation and differences of one
// voxel are linear and change places (docs/equations.md).
#include <glm/gtc/matrix_transform.hpp>

#include "accuracy/metrics.h"
#include "tests/accuracy/estimate_judge.h"

namespace pellucid::test {
namespace {

class GradientTexture : public GpuTest {
protected:
    /// Difference of the pictures with either, in grey levels.
    static accuracy::ImageDifference apart(Scene scene, const VolumePtr& volume) {
        scene.picture.size = {48, 40};
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

}  // namespace
}  // namespace pellucid::test
