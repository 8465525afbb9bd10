// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Surfaces along a ray: first hits and isosurfaces.
#include <algorithm>

#include "accuracy/ray_integrator.h"
#include "accuracy/ray_pieces.h"
#include "accuracy/root.h"

namespace pellucid::accuracy {

std::optional<glm::dvec3> RayIntegrator::firstHit(const ViewRay& ray, double stepMm) const {
    const Scene& scene = m_medium.scene();
    const double threshold = extinctionFromOpacity(scene.hitOpacity) / *scene.unitLengthMm;
    const Optics& optics = m_medium.optics();
    std::optional<glm::dvec3> hit;
    walkVisiblePieces(m_medium, ray, stepMm, [&](const Piece& piece) {
        const auto valueAt = [&](double t) { return m_medium.valueAt(ray, piece.cell, t); };
        const auto t = firstReached(piece.from, piece.to, [&](double s) {
            return optics.extinctionPerMm(piece.optics, valueAt(s)) - threshold;
        });
        if (t) hit = m_medium.shaded(ray, piece.cell, *t, optics.color(piece.optics, valueAt(*t)));
        return !t;
    });
    return hit;
}

std::optional<glm::dvec3> RayIntegrator::isosurface(const ViewRay& ray, double stepMm) const {
    const double isovalue = *m_medium.scene().volumes.front().isovalue;
    const Optics& optics = m_medium.optics();
    std::optional<glm::dvec3> hit;
    walkVisibleCells(m_medium, ray, stepMm, [&](const Segment& segment) {
        const auto t = firstReached(segment.from, segment.to, [&](double s) {
            return m_medium.valueAt(ray, segment.cell, s) - isovalue;
        });
        if (t) hit = m_medium.shaded(ray, segment.cell, *t, optics.color(optics.pieceOf(isovalue), isovalue));
        return !t;
    });
    return hit;
}

glm::dvec4 RayIntegrator::isosurfaces(const ViewRay& ray, double stepMm) const {
    const auto& surfaces = m_medium.surfaces();
    glm::dvec3 color(0.0);
    double transmittance = 1.0;
    const auto levelOf = [&](double value) {
        return std::count_if(surfaces.begin(), surfaces.end(),
                             [&](const SurfaceLayer& surface) { return value >= surface.value; });
    };
    const auto valueOf = [&](const Segment& part, double t) { return m_medium.valueAt(ray, part.cell, t); };
    std::ptrdiff_t level = 0;
    const auto visit = [&](const Segment& part) {
        const auto target = levelOf(valueOf(part, part.to));
        double from = part.from;
        while (level != target) {
            const bool rising = level < target;
            const auto& surface = surfaces[static_cast<std::size_t>(rising ? level : level - 1)];
            // A value on the isovalue has reached it, from either side.
            const auto side = [&](double s) { return valueOf(part, s) >= surface.value ? 1.0 : -1.0; };
            // Where two surfaces are one, or the value jumps at the part's beginning, nothing is left to
            // search.
            const double t = side(from) == side(part.to) ? from : rootBetween(from, part.to, side);
            color += transmittance * surface.opacity * m_medium.shaded(ray, part.cell, t, surface.color);
            transmittance *= 1.0 - surface.opacity;
            level += rising ? 1 : -1;
            from = t;
        }
        return transmittance > 0.0;
    };
    const auto visitQuarters = [&](const Segment& segment) {
        constexpr int kParts = 4;
        const double length = (segment.to - segment.from) / kParts;
        for (int i = 0; i < kParts; ++i) {
            const double from = segment.from + i * length;
            const double to = i + 1 == kParts ? segment.to : from + length;
            if (!visit(Segment{segment.cell, from, to})) return false;
        }
        return true;
    };
    for (const Interval& part : ray.visible) {
        // A surface is what the value crosses, so where a ray begins or comes out of a cut there is none.
        level = levelOf(m_medium.valueAt(ray, m_medium.cellAt(ray, part.from), part.from));
        if (!walkCells(m_medium.field(), ray.index, part, stepMm, visitQuarters)) break;
    }
    return {color, 1.0 - transmittance};
}

}  // namespace pellucid::accuracy
