// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/ray_integrator.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "accuracy/ray_pieces.h"

namespace pellucid::accuracy {

RayIntegrator::RayIntegrator(const Scene& scene, const Volume& volume, double insetVoxels, RayClip clip)
    : m_medium(scene, volume, insetVoxels, std::move(clip)) {}

RayIntegral RayIntegrator::integrate(const ViewRay& ray, const std::vector<Interval>& parts,
                                     double stepMm) const {
    RayIntegral sum;
    const auto visit = [&](const Piece& piece) {
        addSmoothPiece(
            piece.from, piece.to,
            [&](double t) { return m_medium.opticsAt(ray, piece.cell, piece.optics, t); },
            [&](double t, const glm::dvec3& color) { return m_medium.shaded(ray, piece.cell, t, color); },
            m_medium.lit(), sum);
        return true;
    };
    for (const Interval& part : parts) walkPieces(m_medium, ray, part, stepMm, visit);
    return sum;
}

RayIntegral RayIntegrator::glow(const ViewRay& ray, double stepMm) const {
    RayIntegral sum;
    walkVisiblePieces(m_medium, ray, stepMm, [&](const Piece& piece) {
        const double length = piece.to - piece.from;
        for (std::size_t i = 0; i < 3; ++i) {
            const LocalOptics local =
                m_medium.opticsAt(ray, piece.cell, piece.optics, piece.from + kNodes[i] * length);
            const double depth = kWeights[i] * length * local.extinction;
            sum.color += depth * local.color;
            sum.opticalDepth += depth;
        }
        return true;
    });
    return sum;
}

/// The largest sign * value on the ray. Precondition: something is visible.
double RayIntegrator::extremum(const ViewRay& ray, double stepMm, double sign) const {
    double best = -std::numeric_limits<double>::infinity();
    walkVisibleCells(m_medium, ray, stepMm, [&](const Segment& segment) {
        const auto at = [&](double t) { return sign * m_medium.valueAt(ray, segment.cell, t); };
        constexpr int kParts = 4;
        std::array<double, kParts + 1> t{};
        std::array<double, kParts + 1> values{};
        std::size_t highest = 0;
        for (std::size_t i = 0; i <= kParts; ++i) {
            t[i] = segment.from + (segment.to - segment.from) * static_cast<double>(i) / kParts;
            values[i] = at(t[i]);
            if (values[i] > values[highest]) highest = i;
        }
        const double rise =
            *std::max_element(values.begin(), values.end()) - *std::min_element(values.begin(), values.end());
        best = std::max(best, values[highest]);
        if (rise > 0.0 && values[highest] + rise > best)
            best = std::max(best, maximumBetween(t[highest == 0 ? 0 : highest - 1],
                                                 t[std::min<std::size_t>(highest + 1, kParts)], at));
        return true;
    });
    return sign * best;
}

/// Over what is visible. Precondition: something is.
double RayIntegrator::average(const ViewRay& ray, double stepMm) const {
    double sum = 0.0;
    walkVisibleCells(m_medium, ray, stepMm, [&](const Segment& segment) {
        for (std::size_t i = 0; i < 3; ++i) {
            const double length = segment.to - segment.from;
            sum +=
                kWeights[i] * length * m_medium.valueAt(ray, segment.cell, segment.from + kNodes[i] * length);
        }
        return true;
    });
    return sum / ray.visibleMm();
}

std::optional<double> RayIntegrator::slice(const ViewRay& ray) const {
    for (const Interval& part : ray.visible)
        if (ray.sliceMm >= part.from && ray.sliceMm <= part.to)
            return m_medium.valueAt(ray, m_medium.cellAt(ray, ray.sliceMm), ray.sliceMm);
    return std::nullopt;
}

glm::dvec4 RayIntegrator::pixel(double u, double v, double stepMm) const {
    const ViewRay ray = rayAt(u, v);
    const auto shownIfVisible = [&](auto&& f) {
        return m_medium.windowed(ray.visible.empty() ? std::nullopt : std::optional<double>(f()));
    };
    switch (m_medium.scene().mode) {
        case Mode::Composite: {
            const RayIntegral sum = integrate(ray, ray.visible, stepMm);
            return m_medium.blended(sum.color, std::exp(-sum.opticalDepth), -std::expm1(-sum.opticalDepth));
        }
        case Mode::Emission:
            return m_medium.blended(glow(ray, stepMm).color, 1.0, 0.0);
        case Mode::XRay: {
            const double depth = glow(ray, stepMm).opticalDepth;
            const bool transmitted = m_medium.scene().xray == XRayDisplay::Transmittance;
            return {glm::dvec3(transmitted ? std::exp(-depth) : -std::expm1(-depth)), 1.0};
        }
        case Mode::Mip:
            return shownIfVisible([&] { return extremum(ray, stepMm, 1.0); });
        case Mode::MinIp:
            return shownIfVisible([&] { return extremum(ray, stepMm, -1.0); });
        case Mode::Average:
            return shownIfVisible([&] { return average(ray, stepMm); });
        case Mode::FirstHit:
            return m_medium.opaque(firstHit(ray, stepMm));
        case Mode::Isosurface:
            if (!m_medium.surfaces().empty()) {
                const glm::dvec4 seen = isosurfaces(ray, stepMm);
                return m_medium.blended(glm::dvec3(seen), 1.0 - seen.a, seen.a);
            }
            return m_medium.opaque(isosurface(ray, stepMm));
        case Mode::Slice:
            break;
    }
    return m_medium.windowed(slice(ray));
}

}  // namespace pellucid::accuracy
