// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <optional>

#include "accuracy/field.h"
#include "accuracy/optics.h"
#include "accuracy/ray_walk.h"

namespace pellucid::accuracy {

/// What a ray through the medium has met, in the compositing space.
struct RayIntegral {
    glm::dvec3 color{0.0};      ///< Integral of T kappa c ds.
    double opticalDepth = 0.0;  ///< Integral of kappa ds.
};

/// The optical model of a scene along single rays, in double. Emission and absorption after Max 1995,
/// "Optical models for direct volume rendering", IEEE TVCG 1(2).
///
/// Rays are split at cell borders, at the step, and where the value crosses a control point of the transfer
/// function; every piece is then smooth and is integrated by the three-stage Gauss-Legendre collocation
/// (order 6), halved until its optical depth is at most 1/4, so that dense media are no special case.
class RayIntegrator {
public:
    /// `insetVoxels`: the volume ends this far inside the box that its voxels fill.
    /// Precondition: the scene is completed() and valid, with one volume.
    RayIntegrator(const Scene& scene, const Volume& volume, double insetVoxels = 0.0);

    /// The picture's RGBA at a point of the picture plane, u and v in [-1, 1] (v up), as ImageF has it.
    [[nodiscard]] glm::dvec4 pixel(double u, double v, double stepMm) const;

    /// The ray through a point of the picture plane: where it is inside the volume, and its unit direction in
    /// mm.
    struct Ray {
        IndexRay index;
        glm::dvec3 originMm{0.0};  ///< Relative to the volume's centre.
        glm::dvec3 direction{0.0};
        double startMm = 0.0;  ///< t at the near plane.
        double sliceMm = 0.0;  ///< t at the plane through the target.
        std::optional<Interval> inside;
    };
    [[nodiscard]] Ray rayAt(double u, double v) const;

    /// Emission and absorption over a part of a ray.
    [[nodiscard]] RayIntegral integrate(const Ray& ray, const Interval& range, double stepMm) const;

private:
    /// A piece of a ray on which value and optics are smooth.
    struct Piece {
        glm::ivec3 cell{0};
        int optics = 0;
        double from = 0.0;
        double to = 0.0;
    };

    /// Colour and extinction per mm at a point.
    struct LocalOptics {
        glm::dvec3 color{0.0};
        double extinction = 0.0;
    };
    /// Fields of extinction times colour, and of extinction: the transfer function applied to voxels.
    struct PreClassified {
        Field red, green, blue, extinction;
    };

    [[nodiscard]] PreClassified preClassified() const;
    [[nodiscard]] LocalOptics opticsAt(const Ray& ray, const Piece& piece, double t) const;
    [[nodiscard]] double valueAt(const Ray& ray, glm::ivec3 cell, double t) const;
    [[nodiscard]] glm::dvec3 shaded(const Ray& ray, glm::ivec3 cell, double t, glm::dvec3 color) const;
    template <class Visit>
    bool splitAtPoints(const Ray& ray, const Segment& segment, double valueFrom, double valueTo,
                       const Visit& visit) const;
    template <class Visit>
    void walkPieces(const Ray& ray, const Interval& range, double stepMm, const Visit& visit) const;
    void addPiece(const Ray& ray, const Piece& piece, int depth, RayIntegral& sum) const;

    [[nodiscard]] RayIntegral glow(const Ray& ray, double stepMm) const;
    [[nodiscard]] double extremum(const Ray& ray, double stepMm, double sign) const;
    [[nodiscard]] double average(const Ray& ray, double stepMm) const;
    [[nodiscard]] std::optional<glm::dvec3> firstHit(const Ray& ray, double stepMm) const;
    [[nodiscard]] std::optional<glm::dvec3> isosurface(const Ray& ray, double stepMm) const;
    /// Associated colour and opacity of all isosurfaces of the volume.
    [[nodiscard]] glm::dvec4 isosurfaces(const Ray& ray, double stepMm) const;
    [[nodiscard]] glm::dvec4 windowed(const std::optional<double>& value) const;
    [[nodiscard]] glm::dvec4 opaque(const std::optional<glm::dvec3>& color) const;
    [[nodiscard]] glm::dvec4 blended(const glm::dvec3& color, double transmittance, double alpha) const;

    Scene m_scene;
    Field m_field;
    Optics m_optics;
    std::optional<PreClassified> m_preClassified;
    std::vector<SurfaceLayer> m_surfaces;  ///< Ascending; colours in the compositing space.
    RayFrame m_frame;
    double m_inset;
    glm::dvec3 m_centreMm;
    glm::dmat3 m_indexFromPatient;     ///< For vectors.
    glm::dmat3 m_gradientFromIndex;    ///< Its transpose: index gradients to patient gradients.
    double m_vanishingGradient = 0.0;  ///< Per voxel step.
    glm::dvec3 m_background;           ///< In the compositing space.
    bool m_lit = false;
};

}  // namespace pellucid::accuracy
