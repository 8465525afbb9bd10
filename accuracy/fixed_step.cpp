// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/fixed_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "accuracy/smooth_piece.h"
#include "scene/check.h"

namespace pellucid::accuracy {

/// A ray and what its samples have in common.
struct FixedStepIntegrator::Walk {
    const Medium& medium;
    ViewRay ray;
    double toFace = 1.0;
    double mmPerValue = 0.0;

    double value(double t) {
        if (medium.scene().volumes.front().filter == Filter::Nearest) {
            const glm::dvec3 place = ray.index.at(t) + 0.5;
            for (int axis = 0; axis < 3; ++axis) {
                const double face = std::round(place[axis]);
                // Beyond the outer faces the outer voxels go on.
                if (face > 0.0 && face < medium.field().size()[axis])
                    toFace = std::min(toFace, std::abs(place[axis] - face));
            }
        }
        return medium.valueAt(ray, medium.cellAt(ray, t), t);
    }
    LocalOptics optics(double t) {
        if (medium.preClassified()) return medium.opticsAt(ray, medium.cellAt(ray, t), 0, t);
        return medium.optics().at(value(t));
    }
    /// Light is reflected in the middle of a segment.
    SegmentOptics lit(SegmentOptics segment, double middle) const {
        if (segment.depth > 0.0)
            segment.color = medium.shaded(ray, medium.cellAt(ray, middle), middle, segment.color);
        return segment;
    }
};

FixedStepIntegrator::FixedStepIntegrator(const Scene& scene, const Volume& volume)
    : m_medium(scene, volume), m_stepMm(stepMm(scene.quality, volume.grid())) {
    PELLUCID_CHECK(!scene.quality.jitter && scene.mode != Mode::FirstHit && scene.mode != Mode::Isosurface);
}

template <class Visit>
void FixedStepIntegrator::walkSegments(const ViewRay& ray, const Visit& visit) const {
    if (!ray.inside) return;
    const double extent = ray.inside->to - ray.inside->from;
    const auto count = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(extent / m_stepMm)));
    for (std::int64_t i = 0; i < count; ++i) {
        const double from = static_cast<double>(i) * m_stepMm;
        visit(ray.inside->from + from, ray.inside->from + std::min(from + m_stepMm, extent));
    }
}

SegmentOptics FixedStepIntegrator::segment(Walk& walk, double from, double to) const {
    const double length = to - from;
    const double middle = 0.5 * (from + to);
    const Optics& optics = m_medium.optics();
    const auto at = [&](double share) { return walk.optics(from + share * length); };
    switch (m_medium.scene().quality.integrator) {
        case Integrator::Riemann:
            return riemannRule(walk.optics(middle), length);
        case Integrator::Exponential:
            return exponentialRule(walk.optics(middle), length);
        case Integrator::Trapezoid:
            return trapezoidRule(at(0.0), at(1.0), length);
        case Integrator::Simpson:
            return simpsonRule(at(0.0), at(0.5), at(1.0), length);
        case Integrator::GaussLegendre:
            return gaussLegendreRule(at(kGaussFirst), at(1.0 - kGaussFirst), length);
        case Integrator::Preintegrated2D:
        case Integrator::Preintegrated3D:
        case Integrator::Importance:
            return linearValueRule(optics, walk.value(from), walk.value(to), length);
        case Integrator::IntegralFunctions:
        case Integrator::Adaptive:
            break;
    }
    const double front = walk.value(from), back = walk.value(to);
    if (front != back) walk.mmPerValue += length / std::abs(back - front);
    return runningIntegralRule(optics, front, back, length);
}

/// Equation 6.
RayIntegral FixedStepIntegrator::sumOfSegments(Walk& walk) const {
    RayIntegral sum;
    const auto addOptics = [&](const SegmentOptics& optics, double middle) {
        const SegmentOptics seen = walk.lit(optics, middle);
        const double before = std::exp(-sum.opticalDepth);
        sum.opticalDepth += seen.depth;
        sum.color += (before - std::exp(-sum.opticalDepth)) * seen.color;
    };
    const auto add = [&](double from, double to) { addOptics(segment(walk, from, to), 0.5 * (from + to)); };
    const Scene& scene = m_medium.scene();
    const bool adaptive = scene.quality.integrator == Integrator::Adaptive;
    if (adaptive && scene.volumes.front().filter == Filter::Nearest) {
        if (!walk.ray.inside) return sum;
        constexpr double kWholeCells = std::numeric_limits<double>::infinity();
        walkCells(m_medium.field(), walk.ray.index, *walk.ray.inside, kWholeCells, [&](const Segment& cell) {
            const double middle = 0.5 * (cell.from + cell.to);
            addOptics(exponentialRule(walk.optics(middle), cell.to - cell.from), middle);
            return true;
        });
        return sum;
    }
    walkSegments(walk.ray, [&](double from, double to) {
        if (!adaptive) return add(from, to);
        add(from, 0.5 * (from + to));
        add(0.5 * (from + to), to);
    });
    return sum;
}

/// The extreme sample, then eight more within half a step of it (docs/equations.md, Projections).
FixedStepIntegrator::Extremum FixedStepIntegrator::extremum(Walk& walk) const {
    const double sign = m_medium.scene().mode == Mode::Mip ? 1.0 : -1.0;
    const double none = -std::numeric_limits<double>::infinity();
    double greatest = none, second = none, at = 0.0;
    walkSegments(walk.ray, [&](double from, double to) {
        const double middle = 0.5 * (from + to);
        const double value = sign * walk.value(middle);
        // Equal ones are one voxel, of which the first counts.
        if (value != greatest) second = std::max(second, std::min(value, greatest));
        if (value > greatest) at = middle;
        greatest = std::max(greatest, value);
    });
    const double toRunnerUp = greatest - second;
    const double from = std::max(at - 0.5 * m_stepMm, walk.ray.inside->from);
    const double to = std::min(at + 0.5 * m_stepMm, walk.ray.inside->to);
    for (int i = 0; i < 8; ++i)
        greatest = std::max(greatest, sign * walk.value(std::lerp(from, to, (i + 0.5) / 8.0)));
    return {sign * greatest, toRunnerUp};
}

FixedStepIntegrator::Pixel FixedStepIntegrator::pixel(double u, double v) const {
    Walk walk{m_medium, m_medium.rayAt(u, v)};
    const ViewRay& ray = walk.ray;
    const Scene& scene = m_medium.scene();
    const auto done = [&](const glm::dvec4& rgba) { return Pixel{rgba, walk.toFace, walk.mmPerValue}; };
    if (scene.mode == Mode::Composite || scene.mode == Mode::XRay) {
        const RayIntegral sum = sumOfSegments(walk);
        const double opacity = -std::expm1(-sum.opticalDepth);
        if (scene.mode == Mode::Composite) return done(m_medium.blended(sum.color, 1.0 - opacity, opacity));
        return done({glm::dvec3(scene.xray == XRayDisplay::Opacity ? opacity : 1.0 - opacity), 1.0});
    }
    if (!ray.inside && scene.mode != Mode::Emission) return done(m_medium.windowed(std::nullopt));
    if (scene.mode == Mode::Slice) {
        const bool cut = ray.sliceMm >= ray.inside->from && ray.sliceMm <= ray.inside->to;
        return done(m_medium.windowed(cut ? std::optional(walk.value(ray.sliceMm)) : std::nullopt));
    }
    if (scene.mode == Mode::Mip || scene.mode == Mode::MinIp) {
        const Extremum found = extremum(walk);
        Pixel pixel = done(m_medium.windowed(found.value));
        pixel.toRunnerUp = found.toRunnerUp;
        return pixel;
    }
    glm::dvec3 emission(0.0);
    double weighted = 0.0;
    walkSegments(ray, [&](double from, double to) {
        const double middle = 0.5 * (from + to);
        const LocalOptics local = walk.optics(middle);
        emission += (to - from) * local.extinction * local.color;
        weighted += (to - from) * walk.value(middle);
    });
    if (scene.mode == Mode::Emission) return done(m_medium.blended(emission, 1.0, 0.0));
    return done(m_medium.windowed(weighted / ray.visibleMm()));
}

}  // namespace pellucid::accuracy
