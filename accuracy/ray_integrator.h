// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec4.hpp>
#include <optional>

#include "accuracy/medium.h"
#include "accuracy/smooth_piece.h"

namespace pellucid::accuracy {

/// The optical model of a scene along single rays, in double. Emission and absorption after Max 1995,
/// "Optical models for direct volume rendering", IEEE TVCG 1(2).
///
/// Rays are split at clips, at cell borders, at the step, and where the value crosses a control point of the
/// transfer function; every piece is then smooth and is integrated by the three-stage Gauss-Legendre
/// collocation (order 6), halved until its optical depth is at most 1/4, so that dense media are no special
/// case.
class RayIntegrator {
public:
    /// As Medium.
    RayIntegrator(const Scene& scene, const Volume& volume, double insetVoxels = 0.0, RayClip clip = {});

    /// The picture's RGBA at a point of the picture plane, u and v in [-1, 1] (v up), as ImageF has it.
    [[nodiscard]] glm::dvec4 pixel(double u, double v, double stepMm) const;

    [[nodiscard]] ViewRay rayAt(double u, double v) const { return m_medium.rayAt(u, v); }

    /// Emission and absorption over parts of a ray, ascending.
    [[nodiscard]] RayIntegral integrate(const ViewRay& ray, const std::vector<Interval>& parts,
                                        double stepMm) const;

private:
    [[nodiscard]] RayIntegral glow(const ViewRay& ray, double stepMm) const;
    [[nodiscard]] double extremum(const ViewRay& ray, double stepMm, double sign) const;
    [[nodiscard]] double average(const ViewRay& ray, double stepMm) const;
    [[nodiscard]] std::optional<double> slice(const ViewRay& ray) const;
    [[nodiscard]] std::optional<glm::dvec3> firstHit(const ViewRay& ray, double stepMm) const;
    [[nodiscard]] std::optional<glm::dvec3> isosurface(const ViewRay& ray, double stepMm) const;
    /// Associated colour and opacity of all isosurfaces of the volume.
    [[nodiscard]] glm::dvec4 isosurfaces(const ViewRay& ray, double stepMm) const;

    Medium m_medium;
};

}  // namespace pellucid::accuracy
