// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/verify_scenes.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "accuracy/metrics.h"
#include "accuracy/synthetic.h"

namespace pellucid::accuracy {
namespace {

const glm::dvec3 kPerMm = std::numbers::pi / kVerifyBoxMm;
constexpr int kFineVoxels = 24;
// Eye from the middle of the box, whose corners are 25 mm away.
constexpr double kPerspectiveMm = 40.0;
// The function's line: colour and extinction per mm at its two ends, beyond every value.
constexpr double kFrom = -0.5;
constexpr double kTo = 1.5;
constexpr double kExtinctionTo = 0.3;
constexpr glm::dvec3 kColorFrom{0.1, 0.9, 0.3};
constexpr glm::dvec3 kColorTo{1.0, 0.2, 0.7};

double share(double value) {
    return (value - kFrom) / (kTo - kFrom);
}

}  // namespace

Grid verifyGrid(int n) {
    const double spacing = kVerifyBoxMm.x / n;
    return axisAlignedGrid({n, n, n * 3 / 2}, glm::dvec3(spacing), 0.5 * (spacing - kVerifyBoxMm));
}

double bumpAt(glm::dvec3 p, bool inverted) {
    const double bump =
        std::pow(std::cos(kPerMm.x * p.x) * std::cos(kPerMm.y * p.y) * std::cos(kPerMm.z * p.z), 2);
    return inverted ? 1.0 - bump : bump;
}

glm::dvec3 bumpGradient(glm::dvec3 p, bool inverted) {
    const glm::dvec3 c = glm::cos(kPerMm * p);
    const glm::dvec3 s = glm::sin(kPerMm * p);
    const glm::dvec3 squares = c * c;
    const glm::dvec3 slopes = -2.0 * kPerMm * c * s;
    const glm::dvec3 gradient(slopes.x * squares.y * squares.z, squares.x * slopes.y * squares.z,
                              squares.x * squares.y * slopes.z);
    return inverted ? -gradient : gradient;
}

VolumePtr bumpVolume(int n, bool inverted) {
    const Grid grid = verifyGrid(n);
    return sampledVolume(grid, VoxelType::Float32, [&](glm::ivec3 index) {
        return bumpAt(transformPoint(grid.patientFromIndex, glm::dvec3(index)), inverted);
    });
}

VolumePtr wavesVolume() {
    return sampledVolume(verifyGrid(kFineVoxels), VoxelType::Float32, [](glm::ivec3 i) {
        return 0.5 + 0.25 * std::sin(0.7 * i.x) * std::cos(0.65 * i.y) + 0.15 * std::sin(0.6 * i.z + 0.4);
    });
}

VolumePtr roughVolume() {
    return randomVolume(verifyGrid(kFineVoxels), 7);
}

double verifyExtinction(double value) {
    return kExtinctionTo * share(value);
}

glm::dvec3 verifyColor(double value) {
    return kColorFrom + share(value) * (kColorTo - kColorFrom);
}

const char* raysName(Rays rays) {
    constexpr std::array<const char*, 3> kNames{"oblique", "perspective", "along an axis"};
    return kNames[static_cast<std::size_t>(rays)];
}

Scene verifyScene(Mode mode, Filter filter, int pixels, double heightMm, Rays rays) {
    Scene scene;
    VolumeItem item;
    item.filter = filter;
    item.transferFunction =
        TransferFunction1D{"line", "", {{kFrom, kColorFrom, 0.0}, {kTo, kColorTo, kExtinctionTo}}};
    item.window = Window{0.5, 1.5};
    item.isovalue = kVerifyIsovalue;
    scene.volumes.push_back(std::move(item));
    scene.mode = mode;
    scene.lights = std::vector<Light>{};
    if (mode == Mode::Isosurface || mode == Mode::FirstHit) scene.lights->emplace_back();
    scene.hitOpacity = opacityFromExtinction(verifyExtinction(kVerifyIsovalue));
    scene.unitLengthMm = 1.0;
    const bool isPerspective = rays == Rays::Perspective;
    scene.camera.projection = isPerspective ? Projection::Perspective : Projection::Orthographic;
    const glm::dvec3 unit = rays == Rays::AlongAxis ? glm::dvec3(0, 1, 0) : glm::normalize(kVerifyForward);
    const double distance = isPerspective ? kPerspectiveMm : 4.0 * kVerifyBoxMm.z;
    scene.camera.pose = CameraPose{-distance * unit, glm::dvec3(0.0), glm::dvec3(0, 0, 1), heightMm};
    if (isPerspective) scene.camera.fovDeg = glm::degrees(2.0 * std::atan(0.5 * heightMm / kPerspectiveMm));
    // Errors show best where much is seen but not all is opaque.
    scene.densityScale = mode == Mode::XRay ? 0.4 : mode == Mode::Composite ? 2.0 : 1.0;
    scene.quality.earlyTermination = 0.0;
    scene.picture.size = {pixels, pixels};
    return scene;
}

int smoothnessOf(Filter filter) {
    switch (fieldOf(filter)) {
        case Filter::Nearest:
            return 0;
        case Filter::Trilinear:
            return 1;
        case Filter::CatmullRom:
        case Filter::Lanczos3:  // Sinc and window both vanish at the ends: their product has slope 0 there.
            return 2;
        default:
            break;
    }
    return 3;
}

std::string whyOf(Filter filter) {
    constexpr std::array<const char*, 4> kWhy{
        "the value jumps at voxel borders", "the slope jumps at voxel centres",
        "the second derivative jumps at voxel centres", "the third derivative jumps at voxel centres"};
    return kWhy[static_cast<std::size_t>(smoothnessOf(filter))];
}

Result<ImageF> pictureOf(renderer::Renderer& renderer, const Scene& scene, const VolumePtr& volume) {
    auto frame = renderer.render(scene, {volume});
    if (!frame) return tl::unexpected<Error>(frame.error());
    return std::move(frame->image);
}

double meanError(const ImageF& a, const ImageF& b) {
    return difference(a, b).value().meanError;
}

double largestError(const ImageF& a, const ImageF& b) {
    return difference(a, b).value().maxError;
}

}  // namespace pellucid::accuracy
