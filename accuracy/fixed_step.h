// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec4.hpp>
#include <limits>

#include "accuracy/medium.h"
#include "accuracy/segment_rules.h"
#include "accuracy/smooth_piece.h"

namespace pellucid::accuracy {

/// The quadrature that the scene asks for, at the very places where the renderer takes its samples, in double
/// and without tables: what is left between the two pictures is float arithmetic and the tables' resolution.
/// Independent code; only the equations are shared (docs/equations.md, 6 to 13).
///
/// Segments of the scene's step from the entry on, the last one shortened. The adaptive integrator has its
/// longest steps everywhere, each as two halves, or with the nearest filter one segment a voxel, and the
/// importance integrator its shortest.
class FixedStepIntegrator {
public:
    /// Precondition: the scene is completed() and valid, with one volume, without jitter, in a mode that sums
    /// or compares samples (not FirstHit or Isosurface).
    FixedStepIntegrator(const Scene& scene, const Volume& volume);

    struct Pixel {
        glm::dvec4 rgba{0.0};  ///< As ImageF has it.
        /// With the nearest filter, the smallest distance of a sample from a face between two voxels, where
        /// rounding decides which of them it has. Of a gradient it is the same.
        double toFaceVoxels = 1.0;
        /// With running integrals, the sum of length / change of the value over the segments where it
        /// changes: what a rounding of these integrals is magnified by.
        double mmPerValue = 0.0;
        /// Of an extreme value, how far the second of the samples is from the first, in values: rounding
        /// decides around which of equal ones it is looked at more closely.
        double toRunnerUp = std::numeric_limits<double>::infinity();
    };
    /// u and v in [-1, 1] (v up).
    [[nodiscard]] Pixel pixel(double u, double v) const;

private:
    struct Walk;
    struct Extremum {
        double value, toRunnerUp;
    };
    template <class Visit>
    void walkSegments(const ViewRay& ray, const Visit& visit) const;
    [[nodiscard]] SegmentOptics segment(Walk& walk, double from, double to) const;
    [[nodiscard]] RayIntegral sumOfSegments(Walk& walk) const;
    [[nodiscard]] Extremum extremum(Walk& walk) const;

    Medium m_medium;
    double m_stepMm;
};

}  // namespace pellucid::accuracy
