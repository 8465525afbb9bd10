// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "renderer/plan/plan.h"
#include "scene/progress.h"

namespace pellucid::renderer {

/// Integrals over the value, in double and exact: a transfer function is piecewise linear, so tau is and tau
/// * c is quadratic.
class RunningIntegrals {
public:
    explicit RunningIntegrals(const TransferFunction1D& function);

    struct Value {
        glm::dvec3 emission{0.0};  ///< Integral of tau * colour.
        double extinction = 0.0;   ///< Integral of tau.
    };
    /// From the first control point to `value` (negative direction counts negative).
    [[nodiscard]] Value at(double value) const;

private:
    const TransferFunction1D& m_function;
    std::vector<Value> m_atPoints;
};

/// Where a transfer function is pre-integrated: `size` end values lo ... hi on both axes, segment lengths
/// (k / (layers - 1))^2 * full length: colours change most where segments are thin.
struct PreintegrationLayout {
    double lo = 0.0;
    double hi = 1.0;
    int size = 2;
    int layers = 2;
    double depthOfStep =
        1.0;  ///< Optical depth of a full segment of tau = 1: step / unit length * density scale.
    bool operator==(const PreintegrationLayout&) const = default;
};

/// Length is an axis of the table (`preintegrated-3d`); otherwise there are but its ends, none and the full
/// length.
[[nodiscard]] inline bool isPerLength(const PreintegrationLayout& layout) {
    return layout.layers > 2;
}

/// 256 end values for 8-bit data and 512 otherwise, twice as many where the function has pieces narrower than
/// four entries; with the length as third axis 256 and 8 lengths.
[[nodiscard]] PreintegrationLayout layoutPreintegration(const Scene& scene, const Plan& plan,
                                                        const VolumeFacts& facts);

/// Entries x front value, y back value, z length: colour of the segment as seen through itself times mean
/// tau, and mean tau (Engel et al. 2006, equations 4.3 to 4.5; equation 12 of docs/equations.md). Exact: 8 to
/// 64 sub-segments with their exact depth, colour error below (depth / 64)^2. On the diagonal stands the mean
/// over half an entry to both sides, so that a peak narrower than an entry keeps its integral when it is
/// interpolated; at the ends the function itself. A preview neglects the self-attenuation of colour and costs
/// a hundredth.
enum class TableQuality { Exact, Preview };
[[nodiscard]] std::vector<glm::vec4> preintegrate(const TransferFunction1D& function,
                                                  const PreintegrationLayout& layout, TableQuality quality);

/// Running integrals at `size` values lo ... hi, over the position counted in entries, from lo on (equation
/// 13).
[[nodiscard]] std::vector<glm::vec4> tabulateIntegrals(const TransferFunction1D& function, double lo,
                                                       double hi, int size);

/// Entries of the integral table: 1024 for 8-bit data, 4096 otherwise.
[[nodiscard]] int integralTableSize(VoxelType type);

}  // namespace pellucid::renderer
