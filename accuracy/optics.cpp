// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/optics.h"

#include <algorithm>
#include <glm/common.hpp>

#include "scene/image.h"

namespace pellucid::accuracy {

Optics::Optics(const TransferFunction1D& function, CompositingSpace space, double unitLengthMm,
               double densityScale)
    : m_points(function.points) {
    for (TransferPoint& point : m_points) {
        point.extinction *= densityScale / unitLengthMm;
        if (space == CompositingSpace::Linear) point.color = linearFromDisplay(point.color);
    }
}

int Optics::pieceOf(double value) const {
    const auto after = std::upper_bound(m_points.begin(), m_points.end(), value,
                                        [](double v, const TransferPoint& point) { return v < point.value; });
    return static_cast<int>(after - m_points.begin());
}

int Optics::pointBetween(double a, double b) const {
    const auto [lo, hi] = std::minmax(a, b);
    const auto first = std::upper_bound(m_points.begin(), m_points.end(), lo,
                                        [](double v, const TransferPoint& point) { return v < point.value; });
    const auto last = std::lower_bound(first, m_points.end(), hi,
                                       [](const TransferPoint& point, double v) { return point.value < v; });
    if (first == last) return -1;
    return static_cast<int>(first + (last - first) / 2 - m_points.begin());
}

Optics::Place Optics::placeOf(int piece, double value) const {
    const std::size_t upper = std::min(static_cast<std::size_t>(piece), m_points.size() - 1);
    const std::size_t lower = piece == 0 ? 0 : static_cast<std::size_t>(piece) - 1;
    const double width = m_points[upper].value - m_points[lower].value;
    return {lower, upper, width > 0.0 ? std::clamp((value - m_points[lower].value) / width, 0.0, 1.0) : 0.0};
}

glm::dvec3 Optics::color(int piece, double value) const {
    const Place at = placeOf(piece, value);
    return glm::mix(m_points[at.lower].color, m_points[at.upper].color, at.weight);
}

double Optics::extinctionPerMm(int piece, double value) const {
    const Place at = placeOf(piece, value);
    return glm::mix(m_points[at.lower].extinction, m_points[at.upper].extinction, at.weight);
}

}  // namespace pellucid::accuracy
