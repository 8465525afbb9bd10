// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Grid refinement: one analytic field sampled on finer and finer voxels, at a step so fine that only the
// voxels matter, against the closed form of the field integrated along each ray in double.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "accuracy/root.h"
#include "accuracy/verify_scenes.h"
#include "scene/names.h"

namespace pellucid::accuracy {
namespace {

constexpr int kPixels = 12;
constexpr double kHeightMm = 6.0;
constexpr double kStepMm = kVerifyBoxMm.x / 1024.0;

/// Catmull-Rom's two leading terms, h^3 f''' and h^4 f'''', part only on fine voxels; a slice is cheap and
/// not integrated. So are surfaces, where the error of the place and that of the normal add; and with n
/// voxels the two leading terms of Lanczos 3 are as 1 to -(8 / n)^2 (docs/verification.md), so they cancel at
/// n = 8 and the second is 11 % at n = 24.
/// What nearest does to a surface depends on where voxel faces happen to lie: many sizes average that.
std::vector<int> voxelsFor(Mode mode, Filter filter) {
    const bool surface = mode == Mode::FirstHit || mode == Mode::Isosurface;
    if (surface && filter == Filter::Nearest) return {8, 12, 16, 24, 32, 48, 64};
    const bool fine = surface || mode == Mode::Slice;
    return fine ? std::vector{24, 32, 48, 64} : std::vector{8, 12, 16, 24, 32};
}

Scene sceneFor(Mode mode, Filter filter) {
    Scene scene = verifyScene(mode, filter, kPixels, kHeightMm);
    scene.quality.stepMm = kStepMm;
    scene.quality.integrator = Integrator::Simpson;  // where the mode has one
    // The errors before and behind the middle of the bump have opposite signs and weights that depend on the
    // density: Catmull-Rom's leading one changes its sign between densities of 1.5 and 3, and what is left
    // near that has no clean order.
    if (mode == Mode::Composite) scene.densityScale = 0.5;
    // Off the middle, where odd derivatives vanish.
    if (mode == Mode::Slice) {
        const glm::dvec3 aside(4.0, 3.0, -5.0);
        scene.camera.pose->eye += aside;
        scene.camera.pose->target += aside;
    }
    return scene;
}

/// A ray through the bump: where it is inside the box.
struct BumpRay {
    glm::dvec3 origin;
    glm::dvec3 direction;
    double from = 0.0;
    double to = 0.0;
    double slice = 0.0;  ///< Where it meets the plane through the target.
    bool inverted = false;

    [[nodiscard]] double value(double t) const { return bumpAt(origin + t * direction, inverted); }
};

BumpRay rayThrough(const Scene& scene, int x, int y) {
    const RayFrame frame = rayFrame(scene.camera, verifyGrid(2), scene.picture.size);
    const double u = 2.0 * (x + 0.5) / kPixels - 1.0;
    const double v = 1.0 - 2.0 * (y + 0.5) / kPixels;
    BumpRay ray{frame.eye + u * frame.right + v * frame.up,
                frame.forward,
                0.0,
                1e9,
                frame.targetDistanceMm,
                scene.mode == Mode::MinIp};
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (-0.5 * kVerifyBoxMm[axis] - ray.origin[axis]) / ray.direction[axis];
        const double b = (0.5 * kVerifyBoxMm[axis] - ray.origin[axis]) / ray.direction[axis];
        ray.from = std::max(ray.from, std::min(a, b));
        ray.to = std::min(ray.to, std::max(a, b));
    }
    return ray;
}

struct Integrals {
    double value = 0.0, depth = 0.0;
    glm::dvec3 emission{0.0}, color{0.0};
};

/// Midpoints with exact weights of 20000 segments: wrong by some (D k)^2 / (24 * 20000^2) < 1e-8.
Integrals integrals(const BumpRay& ray, double densityScale) {
    constexpr int kSegments = 20000;
    const double length = (ray.to - ray.from) / kSegments;
    Integrals sum;
    for (int i = 0; i < kSegments; ++i) {
        const double value = ray.value(ray.from + (i + 0.5) * length);
        const double before = sum.depth;
        sum.value += value / kSegments;
        sum.depth += densityScale * verifyExtinction(value) * length;
        sum.emission += densityScale * verifyExtinction(value) * length * verifyColor(value);
        sum.color += (std::exp(-before) - std::exp(-sum.depth)) * verifyColor(value);
    }
    return sum;
}

/// A surface lit by the headlight, light and eye in one direction: docs/equations.md (16).
glm::dvec3 litSurface(const Scene& scene, const BumpRay& ray) {
    // The field rises along the ray up to its maximum near the middle, so there is one root before it.
    const double middle = 0.5 * (ray.from + ray.to);
    const double t =
        rootBetween(ray.from, middle, [&](double at) { return ray.value(at) - kVerifyIsovalue; });
    const glm::dvec3 normal = glm::normalize(bumpGradient(ray.origin + t * ray.direction, ray.inverted));
    const double cosine = std::abs(glm::dot(normal, ray.direction));
    const Material& m = scene.material;
    return (m.ambient + m.diffuse * cosine) * verifyColor(kVerifyIsovalue) +
           m.specular * std::pow(cosine, m.shininess);
}

glm::dvec3 exactPixel(const Scene& scene, const BumpRay& ray) {
    const auto windowed = [&](double value) {
        const Window& window = *scene.volumes.front().window;
        return glm::dvec3((value - window.level) / window.width + 0.5);
    };
    const double sign = ray.inverted ? -1.0 : 1.0;
    switch (scene.mode) {
        case Mode::Mip:
        case Mode::MinIp:
            return windowed(sign *
                            maximumBetween(ray.from, ray.to, [&](double t) { return sign * ray.value(t); }));
        case Mode::Slice:
            return windowed(ray.value(ray.slice));
        case Mode::FirstHit:
        case Mode::Isosurface:
            return litSurface(scene, ray);
        default:
            break;
    }
    const Integrals sum = integrals(ray, scene.densityScale);
    if (scene.mode == Mode::Average) return windowed(sum.value);
    if (scene.mode == Mode::XRay) return glm::dvec3(-std::expm1(-sum.depth));
    return scene.mode == Mode::Emission ? sum.emission : sum.color;
}

OrderRow expectation(Mode mode, Filter filter) {
    OrderRow row{"grid", name(mode), "", name(filter)};
    row.tolerance = 0.15;
    // Errors of interpolation: h f' / 2, h^2 f'' / 8, h^2 f'' / 6 (smoothing without prefilter), h^3 (Keys
    // 1981).
    row.expected = filter == Filter::Nearest ? 1.0 : filter == Filter::CatmullRom ? 3.0 : 2.0;
    const bool integrated =
        mode == Mode::Composite || mode == Mode::XRay || mode == Mode::Average || mode == Mode::Emission;
    if (filter == Filter::Nearest) row.reason = "nearest is wrong by half a voxel times the slope";
    if (filter == Filter::TricubicBSpline)
        row.reason = "without a prefilter the B-spline smooths by h^2 f'' / 6";
    if (filter == Filter::CatmullRom) row.reason = "interpolates parabolas exactly (Keys 1981)";
    if (filter == Filter::Lanczos3) {
        row.expected = 1.0;
        row.reason = "does not give a linear ramp back, by a small factor";
    }
    if (integrated && filter == Filter::Nearest) {
        row.expected = 2.0;
        row.reason = "the error of order 1 cancels along a ray: h^2 f'' / 24 is left";
    }
    if (integrated && filter == Filter::CatmullRom) {
        row.reason = "the error of order 3 cancels along a ray: -h^4 f'''' / 80 is left";
        if (mode == Mode::Composite) {
            row.expected = 4.0;
        } else {
            row.claim = Claim::AtLeast;
            row.reason += ", which changes its sign on the way through the bump";
        }
    }
    if (integrated && filter == Filter::Lanczos3) {
        row.claim = Claim::AtLeast;
        row.expected = 3.0;
        row.reason =
            "the errors of order 1 and 3 cancel along a ray; what is left comes near float rounding where "
            "voxels resolve the bump";
    }
    const bool extremum = mode == Mode::Mip || mode == Mode::MinIp;
    if (extremum && (filter == Filter::CatmullRom || filter == Filter::Lanczos3)) {
        row.claim = Claim::AtLeast;
        row.reason += "; the odd derivatives that it is wrong by are small near the top of the bump";
    }
    const bool surface = mode == Mode::FirstHit || mode == Mode::Isosurface;
    if (surface && filter == Filter::CatmullRom) {
        row.claim = Claim::Order;
        row.expected = 2.0;
        row.reason = "normals are central differences: order 2";
    }
    return row;
}

}  // namespace

Result<std::vector<OrderRow>> verifyGridOrders(renderer::Renderer& renderer, const Progress& progress,
                                               const OrderFound& found) {
    std::vector<OrderRow> rows;
    double done = 0.0;
    const auto modes = enumNames<Mode>();
    for (const auto& mode : modes) {
        if (!goOn(progress, done++ / static_cast<double>(modes.size()), fmt::format("grid: {}", mode.name)))
            return fail(ErrorCode::Cancelled, "the verification was cancelled");
        ImageF exact{{kPixels, kPixels}, std::vector<glm::vec4>(kPixels * kPixels)};
        const Scene first = sceneFor(mode.value, Filter::Trilinear);
        std::map<int, VolumePtr> volumes;
        for (int y = 0; y < kPixels; ++y)
            for (int x = 0; x < kPixels; ++x)
                exact.at(x, y) = glm::vec4(glm::vec3(exactPixel(first, rayThrough(first, x, y))), 1.0f);
        for (const auto& filter : enumNames<Filter>()) {
            if (fieldOf(filter.value) != filter.value) continue;  // errors of a field, not of ways to draw it
            OrderRow row = expectation(mode.value, filter.value);
            for (const int n : voxelsFor(mode.value, filter.value)) {
                VolumePtr& volume = volumes[n];
                if (!volume) volume = bumpVolume(n, mode.value == Mode::MinIp);
                const Scene scene = sceneFor(mode.value, filter.value);
                const auto image = pictureOf(renderer, scene, volume);
                if (!image) return tl::unexpected<Error>(image.error());
                row.sizes.push_back(kVerifyBoxMm.x / n);
                row.errors.push_back(meanError(*image, exact));
            }
            if (found) found(row);
            rows.push_back(std::move(row));
        }
    }
    return rows;
}

}  // namespace pellucid::accuracy
