// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

namespace pellucid::accuracy {
namespace {

/// Weights of the voxels base + first, base + first + 1, ... along one axis; x is the distance from the base
/// voxel.
struct Taps {
    int first = 0;
    int count = 1;
    std::array<double, 6> weights{1.0};
};

double sinc(double x) {
    const double angle = std::numbers::pi * x;
    return std::abs(angle) < 1e-8 ? 1.0 : std::sin(angle) / angle;
}

/// Lanczos-windowed sinc of half-width 3, normalised to sum 1.
Taps lanczosTaps(double x) {
    Taps taps{-2, 6, {}};
    double sum = 0.0;
    for (int i = 0; i < 6; ++i) {
        const double distance = x + 2.0 - i;
        sum += taps.weights[static_cast<std::size_t>(i)] = sinc(distance) * sinc(distance / 3.0);
    }
    for (double& weight : taps.weights) weight /= sum;
    return taps;
}

Taps tapsOf(Filter filter, double x) {
    const double x2 = x * x;
    const double x3 = x2 * x;
    switch (filter) {
        case Filter::Nearest:
            return {};
        case Filter::Trilinear:
            return {0, 2, {1.0 - x, x}};
        case Filter::TricubicBSpline:  // Uniform cubic B-spline of the voxels themselves: it smooths.
            return {-1,
                    4,
                    {(1.0 - 3.0 * x + 3.0 * x2 - x3) / 6.0, (4.0 - 6.0 * x2 + 3.0 * x3) / 6.0,
                     (1.0 + 3.0 * x + 3.0 * x2 - 3.0 * x3) / 6.0, x3 / 6.0}};
        case Filter::Lanczos3:
            return lanczosTaps(x);
        default:
            break;
    }
    // Catmull-Rom.
    return {-1,
            4,
            {(-x + 2.0 * x2 - x3) / 2.0, (2.0 - 5.0 * x2 + 3.0 * x3) / 2.0, (x + 4.0 * x2 - 3.0 * x3) / 2.0,
             (x3 - x2) / 2.0}};
}

}  // namespace

Field::Field(const Volume& volume, int component, Filter filter)
    : Field(volume.grid().size, filter, physicalValues<double>(volume, component)) {}

Field::Field(glm::ivec3 size, Filter filter, std::vector<double> voxels)
    : m_size(size), m_filter(fieldOf(filter)), m_values(std::move(voxels)) {}

glm::ivec3 Field::cellOf(glm::dvec3 index) const {
    // Nearest: cell i is voxel i, from i - 0.5 on. Otherwise cell i lies between voxels i and i + 1.
    return glm::ivec3(glm::floor(index + cellOffset()));
}

double Field::voxel(int i, int j, int k) const {
    const int ci = std::clamp(i, 0, m_size.x - 1);
    const int cj = std::clamp(j, 0, m_size.y - 1);
    const int ck = std::clamp(k, 0, m_size.z - 1);
    return m_values[(static_cast<std::size_t>(ck) * m_size.y + cj) * m_size.x + ci];
}

double Field::value(glm::ivec3 cell, glm::dvec3 index) const {
    const Taps x = tapsOf(m_filter, index.x - cell.x);
    const Taps y = tapsOf(m_filter, index.y - cell.y);
    const Taps z = tapsOf(m_filter, index.z - cell.z);
    double sum = 0.0;
    for (int k = 0; k < z.count; ++k) {
        double plane = 0.0;
        for (int j = 0; j < y.count; ++j) {
            double row = 0.0;
            for (int i = 0; i < x.count; ++i)
                row += x.weights[static_cast<std::size_t>(i)] *
                       voxel(cell.x + x.first + i, cell.y + y.first + j, cell.z + z.first + k);
            plane += y.weights[static_cast<std::size_t>(j)] * row;
        }
        sum += z.weights[static_cast<std::size_t>(k)] * plane;
    }
    return sum;
}

glm::dvec3 Field::centralDifference(glm::ivec3 cell, glm::dvec3 index) const {
    glm::dvec3 result(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        glm::ivec3 one(0);
        one[axis] = 1;
        const glm::dvec3 step(one);
        result[axis] = (value(cell + one, index + step) - value(cell - one, index - step)) / 2.0;
    }
    return result;
}

}  // namespace pellucid::accuracy
