// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Pre-, post- and pre-integrated classification against each other, closed forms and the reference.
#include <gmock/gmock.h>

#include <random>

#include "accuracy/metrics.h"
#include "accuracy/reference.h"
#include "tests/accuracy/gpu_fixture.h"

namespace pellucid::test {
namespace {

constexpr glm::dvec3 kOblique(0.4, 1.0, -0.3);

class ClassificationOrder : public GpuTest {
protected:
    static ImageF reference(const Scene& scene, const VolumePtr& volume) {
        auto picture = accuracy::referencePicture(scene, {volume}, {1e-4, 2, {}});
        EXPECT_TRUE(picture) << (picture ? "" : picture.error().text());
        return picture ? std::move(picture->image) : ImageF{};
    }
    static double rmse(const ImageF& a, const ImageF& b) { return accuracy::difference(a, b).value().rmse; }
};

/// Smooth: the value changes by up to 5.5 entries of a function of 256 a voxel.
VolumePtr bump() {
    return accuracy::sampledVolume(axisAlignedGrid({32, 32, 32}), VoxelType::UInt8,
                                   [](glm::ivec3 i) {
                                       const glm::dvec3 d = glm::dvec3(i) - 15.5;
                                       return 64.0 * std::exp(-glm::dot(d, d) / 100.0);
                                   },
                                   {1.0 / 255.0, 0.0, ""});
}

/// 256 colours and extinctions at random.
TransferFunction1D randomFunction(unsigned seed) {
    std::mt19937 random(seed);
    const auto next = [&] { return static_cast<double>(random()) * 0x1p-32; };
    TransferFunction1D function;
    for (int i = 0; i < 256; ++i) {
        const glm::dvec3 color(next(), next(), next());
        function.points.push_back({i / 255.0, color, 0.3 * next()});
    }
    return function;
}

Scene sceneWith(const TransferFunction1D& function, const VolumePtr& volume) {
    Scene scene = sceneOf(function, orthographicAlong(volume->grid(), kOblique, 26.0), {20, 20});
    scene.quality.stepVoxels = 1.0;
    return scene;
}

/// B4.7a: at one sample a voxel, what the function does between two voxels is lost by pre-classification,
/// what it does between two samples by post-classification, and neither by pre-integration. Found with 2.7 to
/// 11 entries a voxel. With 1.4 post-classification is already as good as the 256 end values of the table;
/// with 22 the colours of neighbouring voxels and samples have nothing to do with each other, and both are
/// equally wrong.
TEST_F(ClassificationOrder, PreIsWorseThanPostIsWorseThanPreintegrated) {
    const VolumePtr volume = bump();
    for (const unsigned seed : {1u, 2u, 3u}) {
        Scene scene = sceneWith(randomFunction(seed), volume);
        const ImageF exact = reference(scene, volume);
        const double post = rmse(draw(scene, volume), exact);
        scene.volumes[0].classification = Classification::Pre;
        const double pre = rmse(draw(scene, volume), exact);
        scene.volumes[0].classification = Classification::Post;
        scene.quality.integrator = Integrator::Preintegrated2D;
        const double integrated = rmse(draw(scene, volume), exact);
        EXPECT_GT(pre, post) << seed;
        EXPECT_GT(post, integrated) << seed;
        RecordProperty("pre" + std::to_string(seed), std::to_string(pre));
        RecordProperty("post" + std::to_string(seed), std::to_string(post));
        RecordProperty("integrated" + std::to_string(seed), std::to_string(integrated));
    }
}

/// Interpolated colours are a field of their own, which the renderer and the reference make independently. On
/// voxels at random a ray of some 50 cells has bends of an extinction of up to 0.3 at each border: h^2 / 8
/// each at a sixteenth of a voxel.
TEST_F(ClassificationOrder, PreClassifiedPicturesAreThoseOfTheReference) {
    const VolumePtr volume = accuracy::randomVolume(axisAlignedGrid({16, 16, 16}, {0.9, 1.0, 1.2}), 4);
    for (const Mode mode : {Mode::Composite, Mode::XRay, Mode::Emission})
        for (const Filter filter : {Filter::Nearest, Filter::Trilinear, Filter::TrilinearExact})
            for (const bool lit : {false, true}) {
                Scene scene = sceneWith(randomFunction(5), volume);
                scene.mode = mode;
                scene.volumes[0].filter = filter;
                scene.volumes[0].classification = Classification::Pre;
                if (lit) scene.lights->push_back(Light{});
                if (mode != Mode::Composite && (lit || filter != Filter::Trilinear)) continue;
                if (lit && filter != Filter::Trilinear) continue;
                scene.quality.stepVoxels = filter == Filter::Nearest ? 1.0 / 512.0 : 1.0 / 32.0;
                EXPECT_LE(shareBeyond(draw(scene, volume), reference(scene, volume), 1.0 / 255.0),
                          lit ? 0.01 : 0.0)
                    << name(mode) << ' ' << name(filter) << " lit " << lit;
            }
}

/// Where associated colour and extinction are linear in the value, interpolating before or after is the same.
TEST_F(ClassificationOrder, ALinearFunctionOfOneColourIsTheSameBeforeAndAfter) {
    const VolumePtr volume = accuracy::randomVolume(axisAlignedGrid({12, 12, 12}), 6);
    Scene scene = sceneWith(linearExtinction({0.9, 0.5, 0.1}, 0.4), volume);
    const ImageF post = draw(scene, volume);
    scene.volumes[0].classification = Classification::Pre;
    // Texture units may round interpolated extinctions; else float roundings of some 30 samples.
    EXPECT_LE(largestDifference(draw(scene, volume), post), 1e-5 + filterError());
}

/// A peak that no voxel has the value of: post-classification shows it, pre-classification cannot.
TEST_F(ClassificationOrder, APeakBetweenTwoVoxelsIsLostBeforeAndSeenAfter) {
    const VolumePtr volume = rampVolume(axisAlignedGrid({1, 8, 1}), 0.0, 1.0 / 7.0);
    const TransferFunction1D box{
        "", "", {{0.47, {1, 1, 1}, 0}, {0.47, {1, 1, 1}, 2}, {0.53, {1, 1, 1}, 2}, {0.53, {1, 1, 1}, 0}}};
    Scene scene = rayScene(box, volume->grid(), {0, 1, 0});
    scene.camera.pose->heightMm = 0.5;
    scene.quality.stepVoxels = 1.0 / 256.0;
    // 0.06 of the value are 0.42 mm.
    EXPECT_NEAR(drawRay(scene, volume).a, -std::expm1(-2.0 * 0.42), 0.01);
    scene.volumes[0].classification = Classification::Pre;
    EXPECT_EQ(drawRay(scene, volume).a, 0.0);
}

TEST(ClassificationRefusals, SayWhatToTakeInstead) {
    const VolumePtr volume = constantVolume(axisAlignedGrid({4, 4, 4}), 0.5);
    Scene scene = rayScene(linearExtinction({1, 1, 1}, 1.0), volume->grid(), {0, 1, 0});
    scene.volumes[0].classification = Classification::Pre;
    const auto refusal = [&] {
        const auto plan = renderer::makePlan(scene, {renderer::factsOf(*volume, 0)});
        return plan ? std::string("accepted") : plan.error().text();
    };
    EXPECT_EQ(refusal(), "accepted");
    scene.quality.automatic = true;
    EXPECT_THAT(refusal(), testing::HasSubstr("state stepVoxels"));
    scene.quality.automatic = false;
    scene.volumes[0].filter = Filter::CatmullRom;
    EXPECT_THAT(refusal(),
                testing::AllOf(testing::HasSubstr("catmull-rom"), testing::HasSubstr("trilinear")));
    scene.volumes[0].filter = Filter::Trilinear;
    scene.quality.integrator = Integrator::Simpson;
    EXPECT_THAT(refusal(), testing::AllOf(testing::HasSubstr("simpson"), testing::HasSubstr("exponential")));
    scene.mode = Mode::Mip;  // where it does not matter
    EXPECT_EQ(refusal(), "accepted");
}

}  // namespace
}  // namespace pellucid::test
