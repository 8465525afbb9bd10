// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Every integrator x projection x filter, with modes, lights and gradient sources pairwise: the picture
// against the same quadrature at the same sample places in double (accuracy/fixed_step.h), so that the only
// difference is float arithmetic and what tables hold between their entries.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "accuracy/fixed_step.h"
#include "renderer/plan/features.h"
#include "scene/names.h"
#include "tests/accuracy/gpu_fixture.h"

namespace pellucid::test {
namespace {

constexpr glm::dvec3 kOblique(0.4, 1.0, -0.3);
constexpr int kVoxels = 14;  // along the longest axis
constexpr int kPixels = 9;

constexpr double kSteps = 32767.0;  // stored values: texels of values and of differences are exact

/// A slope with waves on it: filters differ, and no central difference vanishes.
VolumePtr slopingWaves() {
    return accuracy::sampledVolume(axisAlignedGrid({12, kVoxels, 10}, {1.0, 0.9, 1.2}), VoxelType::UInt16,
                                   [](glm::ivec3 i) {
                                       const glm::dvec3 p = glm::dvec3(i) - glm::dvec3(5.5, 6.5, 4.5);
                                       const double slope = 0.022 * p.x + 0.018 * p.y - 0.024 * p.z;
                                       const double waves = std::sin(1.9 * p.x) * std::cos(1.4 * p.y) +
                                                            std::sin(1.6 * p.z + 0.3 * p.x);
                                       return kSteps * (0.5 + slope + 0.004 * waves);
                                   },
                                   {1.0 / kSteps, 0.0, ""});
}
constexpr double kLeastSlope = 0.015;  // of a central difference, per voxel: checked below
constexpr double kMostSlope = 0.045;   // between neighbours, per voxel and axis: checked below

constexpr double kStepVoxels = 1.53;

/// One line over every value that a filter can make: tables of the function are exact, and pre-integrated
/// segments smooth.
constexpr double kExtinctionAtOne = 0.5;  // per mm
constexpr double kSlopeOfExtinction = 0.45;
constexpr double kSlopeOfColor = 0.7;
TransferFunction1D lineFunction() {
    const auto at = [](double v) {
        return TransferPoint{v, glm::dvec3(0.1, 0.9, 0.5) + v * kSlopeOfColor * glm::dvec3(1.0, -1.0, 0.2),
                             kExtinctionAtOne + (v - 1.0) * kSlopeOfExtinction};
    };
    return {"line", "", {at(-0.1), at(1.2)}};
}

/// What is drawn beside integrator, projection and filter.
enum class Look { Composite, LitOnTheFly, LitTexture, XRayOpacity, XRayTransmittance };
constexpr int kLooks = 5;

struct Combination {
    Integrator integrator;
    Filter filter;
    bool perspective;
    Look look;
};

bool isLit(Look look) {
    return look == Look::LitOnTheFly || look == Look::LitTexture;
}

/// Lit: seven values a sample, 216 fetches each with Lanczos, three segments an adaptive step.
bool compilesForSeconds(const Combination& c) {
    if (c.integrator == Integrator::Adaptive)
        return c.filter != Filter::Nearest && fieldOf(c.filter) != Filter::Trilinear;
    return c.filter == Filter::Lanczos3 && c.integrator != Integrator::Riemann &&
           c.integrator != Integrator::Exponential;
}

std::vector<Combination> combinationsOf(Integrator integrator) {
    std::vector<Combination> list;
    const int i = static_cast<int>(integrator);
    for (const auto& filter : enumNames<Filter>()) {
        if (integrator == Integrator::Importance && !boundsBends(filter.value)) continue;
        for (const bool perspective : {false, true}) {
            // Importance has few filters: all looks in turn.
            const int look = integrator == Integrator::Importance
                                 ? static_cast<int>(list.size())
                                 : i + 4 * static_cast<int>(filter.value) + 3 * int{perspective};
            Combination c{integrator, filter.value, perspective, static_cast<Look>(look % kLooks)};
            if (isLit(c.look) && compilesForSeconds(c)) c.look = Look::Composite;
            list.push_back(c);
        }
    }
    return list;
}

Scene sceneFor(const Combination& c, const Grid& grid) {
    Scene scene = sceneOf(
        lineFunction(),
        c.perspective ? perspectiveAlong(grid, kOblique, 3.0, 20.0) : orthographicAlong(grid, kOblique, 9.0),
        {kPixels, kPixels});
    // The middle of the volume lies on faces of voxels.
    const glm::dvec3 aside(0.13, 0.21, 0.17);
    scene.camera.pose->eye += aside;
    scene.camera.pose->target += aside;
    scene.volumes.front().filter = c.filter;
    scene.picture.background = {0.3, 0.1, 0.5};
    scene.quality.integrator = c.integrator;
    scene.quality.stepVoxels = kStepVoxels;
    if (c.look == Look::XRayOpacity || c.look == Look::XRayTransmittance) scene.mode = Mode::XRay;
    scene.xray = c.look == Look::XRayOpacity ? XRayDisplay::Opacity : XRayDisplay::Transmittance;
    if (isLit(c.look)) {
        // From the eye, where a normal that turns to the viewer makes no jump, and a point.
        scene.lights = std::vector<Light>{Light{}};
        const bool texture = c.look == Look::LitTexture && c.filter == Filter::Trilinear;  // which has one
        scene.quality.gradients = texture ? Gradients::Texture : Gradients::OnTheFly;
    }
    // So loose that adaptive steps are the longest everywhere, so tight that importance steps are the
    // shortest.
    if (c.integrator == Integrator::Adaptive) scene.quality.toleranceGreyLevels = 1e9;
    if (c.integrator == Integrator::Importance) scene.quality.toleranceGreyLevels = 1e-6;
    return scene;
}

/// What a filter does with errors.
struct FilterFacts {
    double slope;  ///< Steepest, in differences of neighbouring voxels: of a cubic 1.5, of Lanczos below 2.
    double roundings;  ///< Of its sum, weights included.
    double weights;    ///< Largest sum of absolute weights in three axes (renderer::reachableValues).
    double table;      ///< Of its weights, three axes.
};
FilterFacts factsOf(Filter filter) {
    switch (filter) {
        case Filter::Nearest:
            return {0.0, 1.0, 1.0, 0.0};
        case Filter::Trilinear:
        case Filter::TrilinearExact:
            return {1.0, 3.0 * 3.0, 1.0, 0.0};  // three linear interpolations of three operations
        case Filter::CatmullRom:
            return {1.5, 3.0 * (3.0 + 4.0), 1.953125,
                    0.0};  // three sums of three, weights of four operations
        case Filter::Lanczos3:
            return {2.0, 3.0 * (6.0 + 8.0), 3.7, 0.0};
        case Filter::TricubicBSplineLut:
            return {1.0, 3.0 * 4.0, 1.0, 3.0 * 1.6e-5};
        default:
            break;
    }
    return {1.0, 3.0 * (4.0 + 4.0), 1.0, 0.0};
}

/// Places. A texture coordinate is origin + t * direction with parts up to 2, each after some 8 roundings:
/// 32 units of 2^-24; so many voxels.
constexpr double kPlace = 32.0 * kFloatUlp * kVoxels;

/// Errors of a value, and of half the difference of two values one voxel to both sides.
struct ValueErrors {
    double value, difference;
};
ValueErrors valueErrors(Filter filter, double filterError) {
    const FilterFacts facts = factsOf(filter);
    const double rounding = facts.roundings * facts.weights * kFloatUlp + filterError;
    // Wrong weights that sum to 1 count as much as the values under the filter differ, three steps an axis.
    const double table = facts.table * 3.0 * 3.0 * kMostSlope;
    // A value is wrong by the slope times the place, along three axes. Both values of a difference have the
    // same place and weights, up to the rounding of a coordinate; their slopes differ by less than twice the
    // steepest.
    return {3.0 * facts.slope * kMostSlope * kPlace + rounding + table,
            facts.slope * kMostSlope * (2.0 * kPlace + kFloatUlp * kVoxels) + rounding +
                facts.table * 2.0 * kMostSlope};
}

/// Of the roundings of sums over segments and of the exponential function.
double sumErrors(double segments) {
    return (2.0 * segments + 8.0) * kFloatUlp;
}

double longestMm(const Grid& grid) {
    return 2.0 * radiusMm(grid);
}
double mostSegments(const Grid& grid) {
    return longestMm(grid) / (kStepVoxels * 0.9) + 1.0;
}

/// What float arithmetic and tables may change, derived.
double boundFor(const Combination& c, const Grid& grid, double filterError, double mmPerValue) {
    const ValueErrors errors = valueErrors(c.filter, filterError);
    const double segments = mostSegments(grid);
    double color = kSlopeOfColor * errors.value;
    double depths = longestMm(grid) * kSlopeOfExtinction * errors.value;
    if (renderer::usesPreintegration(c.integrator)) {
        // Over 256 entries of the range of the function: where both second derivatives are below D,
        // interpolation along two axes misses 2 h^2 / 8 D, and a mean over an entry's neighbourhood h^2 / 12
        // D. The colour of an entry bends by less than the square of its segment's depth; the mean extinction
        // is linear in both ends. Of the change of colour in a segment, sub-segments of (12) miss (depth /
        // 64)^2, and interpolation between lengths what is not linear in the depth when the extinction
        // changes by D_kappa: expanded, depth D_kappa d / 120. Lengths are the squares of k / 7: what is
        // linear in them is missed by 1 / 4 of a seventh's square between two k, of depth / 12 in all.
        const double h = 1.3 / 255.0;
        const double depth = kExtinctionAtOne * kStepVoxels;  // a voxel has 1 mm and less
        const double valueChange = 3.0 * std::max(factsOf(c.filter).slope, 1.0) * kMostSlope * kStepVoxels;
        const double depthChange = kSlopeOfExtinction * valueChange * kStepVoxels;
        color += h * h / 3.0 * depth * depth +
                 kSlopeOfColor * valueChange *
                     (depth * depth / 4096.0 + depth * depthChange / 120.0 + depth / 12.0 / (4.0 * 49.0));
        depths += longestMm(grid) * kExtinctionAtOne * 4.0 * kFloatUlp;
    }
    if (c.integrator == Integrator::IntegralFunctions || c.integrator == Integrator::Adaptive) {
        // Running integrals count in entries, 4095 of them times a mean of at most kExtinctionAtOne, as
        // floats; the difference of two, with those of the interpolation between entries, has four roundings.
        // Over the entries between its ends it is the mean tau, so that a segment's depth is wrong by its
        // length times this, and its colour's weight twice.
        const double integral = 4095.0 * kExtinctionAtOne * 4.0 * kFloatUlp;
        depths += 3.0 * integral * mmPerValue / (4095.0 / 2.0);
    }
    // A normal is wrong by the error of the difference over its length; diffuse light changes with it by k_d,
    // a highlight by k_s sqrt(exponent / e).
    if (isLit(c.look)) {
        const Material material;
        const double highlight = material.specular * std::sqrt(material.shininess / std::exp(1.0));
        color += (material.diffuse + highlight) * std::sqrt(3.0) * errors.difference / kLeastSlope;
    }
    // Weights of the colours sum to at most 1. Depths wrong by d_i change what is seen by at most their sum.
    return color + depths + sumErrors(segments);
}

class Combinations : public GpuTest, public testing::WithParamInterface<Integrator> {};

TEST(CombinationsCover, EveryPairOfFactors) {
    std::set<std::pair<int, int>> pairs[3];
    for (const auto& integrator : enumNames<Integrator>())
        for (const Combination& c : combinationsOf(integrator.value)) {
            const int look = static_cast<int>(c.look);
            pairs[0].emplace(static_cast<int>(c.integrator), look);
            pairs[1].emplace(static_cast<int>(c.filter), look);
            pairs[2].emplace(int{c.perspective}, look);
        }
    EXPECT_EQ(pairs[0].size(), enumNames<Integrator>().size() * kLooks);
    EXPECT_EQ(pairs[1].size(), enumNames<Filter>().size() * kLooks);
    EXPECT_EQ(pairs[2].size(), 2u * kLooks);
}

TEST(CombinationsCover, SlopesThatTheBoundIsDerivedFrom) {
    const VolumePtr volume = slopingWaves();
    const accuracy::Field field(*volume, 0, Filter::Nearest);
    const glm::ivec3 size = field.size();
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
                const glm::ivec3 cell(i, j, k);
                const glm::dvec3 slope = field.centralDifference(cell, glm::dvec3(cell));
                EXPECT_GE(glm::length(slope), kLeastSlope) << i << ' ' << j << ' ' << k;
                for (int axis = 0; axis < 3; ++axis) {
                    glm::ivec3 next = cell;
                    if (++next[axis] >= size[axis]) continue;
                    EXPECT_LE(
                        std::abs(field.value(next, glm::dvec3(next)) - field.value(cell, glm::dvec3(cell))),
                        kMostSlope);
                }
            }
}

/// Largest difference over pixels and channels; of pixels with a nearest sample on a face, where rounding
/// decides which voxel it has, or two extreme samples that differ by no more than values are wrong, there may
/// be few.
struct Compared {
    double worst = 0.0;
    double mmPerValue = 0.0;  ///< Of the ray where it is largest.
};
Compared compare(const ImageF& image, const Scene& scene, const VolumePtr& volume, double valueError) {
    const accuracy::FixedStepIntegrator exact(scene, *volume);
    Compared result;
    int undecided = 0;
    for (int y = 0; y < kPixels; ++y)
        for (int x = 0; x < kPixels; ++x) {
            const auto pixel = exact.pixel(pictureU(x, kPixels), pictureV(y, kPixels));
            if (pixel.toFaceVoxels < kPlace || pixel.toRunnerUp < 2.0 * valueError) {
                ++undecided;
                continue;
            }
            result.mmPerValue = std::max(result.mmPerValue, pixel.mmPerValue);
            for (int channel = 0; channel < 4; ++channel)
                result.worst = std::max(result.worst, std::abs(static_cast<double>(image.at(x, y)[channel]) -
                                                               pixel.rgba[channel]));
        }
    EXPECT_LE(undecided, kPixels * kPixels / 20);
    return result;
}

TEST_P(Combinations, AreTheSameQuadratureInDouble) {
    const VolumePtr volume = slopingWaves();
    for (const Combination& c : combinationsOf(GetParam())) {
        const Scene scene = completed(sceneFor(c, volume->grid()), {volume});
        const ImageF image = draw(scene, volume);
        ASSERT_EQ(image.size, glm::ivec2(kPixels));
        const Compared found = compare(image, scene, volume, valueErrors(c.filter, filterError()).value);
        const double bound = boundFor(c, volume->grid(), filterError(), found.mmPerValue);
        EXPECT_LE(found.worst, bound)
            << name(c.filter) << " perspective " << c.perspective << " look " << static_cast<int>(c.look);
    }
}

/// The modes whose samples are summed or compared without an integrator, every filter, each projection with
/// half of them.
TEST_F(GpuTest, ModesWithoutIntegratorAreTheSameSamplesInDouble) {
    const VolumePtr volume = slopingWaves();
    int index = 0;
    for (const Mode mode : {Mode::Emission, Mode::Average, Mode::Mip, Mode::MinIp, Mode::Slice})
        for (const auto& filter : enumNames<Filter>()) {
            Combination c{Integrator::Exponential, filter.value, index++ % 2 == 1, Look::Composite};
            Scene scene = sceneFor(c, volume->grid());
            scene.mode = mode;
            scene = completed(scene, {volume});
            const ImageF image = draw(scene, volume);
            ASSERT_EQ(image.size, glm::ivec2(kPixels));
            // The window's width is 1. A glow is the sum of kappa c d: at most the slope of kappa c (0.3)
            // times the ray, and its roundings are those of a sum of up to 2.
            const double valueError = valueErrors(filter.value, filterError()).value;
            double bound = valueError + sumErrors(mostSegments(volume->grid()));
            if (mode == Mode::Emission)
                bound =
                    0.3 * longestMm(volume->grid()) * bound + 2.0 * sumErrors(mostSegments(volume->grid()));
            EXPECT_LE(compare(image, scene, volume, valueError).worst, bound)
                << name(mode) << ' ' << filter.name;
        }
}

std::vector<Integrator> allIntegrators() {
    std::vector<Integrator> all;
    for (const auto& entry : enumNames<Integrator>()) all.push_back(entry.value);
    return all;
}

INSTANTIATE_TEST_SUITE_P(Every, Combinations, testing::ValuesIn(allIntegrators()), [](const auto& tested) {
    std::string text = name(tested.param);
    std::replace(text.begin(), text.end(), '-', '_');
    return text;
});

}  // namespace
}  // namespace pellucid::test
