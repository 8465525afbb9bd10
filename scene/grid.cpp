// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace pellucid {

namespace {

/// Columns of the linear part divided by their lengths, so that 1:1000 spacings do not look singular.
struct ScaledColumns {
    glm::dmat3 unit{1.0};
    glm::dvec3 length{1.0};
};

ScaledColumns scaledColumns(const glm::dmat4& matrix) {
    ScaledColumns result;
    for (int axis = 0; axis < 3; ++axis) {
        const glm::dvec3 column(matrix[axis]);
        // hypot neither overflows nor underflows where the squares would.
        result.length[axis] = std::hypot(column.x, column.y, column.z);
        result.unit[axis] = column / result.length[axis];
    }
    return result;
}

}  // namespace

Grid axisAlignedGrid(glm::ivec3 size, glm::dvec3 spacingMm, glm::dvec3 originMm) {
    Grid grid;
    grid.size = size;
    for (int axis = 0; axis < 3; ++axis) grid.patientFromIndex[axis][axis] = spacingMm[axis];
    grid.patientFromIndex[3] = glm::dvec4(originMm, 1.0);
    return grid;
}

Result<void> validate(const Grid& grid) {
    for (int axis = 0; axis < 3; ++axis) {
        if (grid.size[axis] < 1)
            return fail(
                ErrorCode::InvalidArgument,
                fmt::format("grid size along {} is {}, allowed is at least 1", "ijk"[axis], grid.size[axis]));
    }
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            const double entry = grid.patientFromIndex[column][row];
            if (!std::isfinite(entry))
                return fail(ErrorCode::InvalidArgument,
                            fmt::format("patientFromIndex row {} column {} is {}, allowed is a finite number",
                                        row, column, entry));
        }
        const double last = column == 3 ? 1.0 : 0.0;
        if (grid.patientFromIndex[column][3] != last)
            return fail(
                ErrorCode::InvalidArgument,
                fmt::format("patientFromIndex has {} in column {} of its last row, which must be 0 0 0 1",
                            grid.patientFromIndex[column][3], column));
    }
    const ScaledColumns columns = scaledColumns(grid.patientFromIndex);
    for (int axis = 0; axis < 3; ++axis) {
        // 1 / length must be finite too: it is an entry of the inverse.
        if (!std::isfinite(columns.length[axis]) || !std::isnormal(columns.length[axis]) ||
            !std::isfinite(1.0 / columns.length[axis]))
            return fail(ErrorCode::InvalidArgument,
                        fmt::format("the voxel spacing along {} is {} mm; it must be above 0", "ijk"[axis],
                                    columns.length[axis]));
    }
    // Columns of length 1: below this the axes lie in one plane as far as double precision can tell.
    if (std::abs(glm::determinant(columns.unit)) < 1e-10)
        return fail(ErrorCode::InvalidArgument,
                    "patientFromIndex has no inverse: the three voxel axes lie in one plane");
    return {};
}

Result<std::uint64_t> checkedVoxelCount(glm::ivec3 size) {
    std::uint64_t count = 1;
    for (int axis = 0; axis < 3; ++axis) {
        if (size[axis] < 1)
            return fail(
                ErrorCode::InvalidArgument,
                fmt::format("grid size along {} is {}, allowed is at least 1", "ijk"[axis], size[axis]));
        if (__builtin_mul_overflow(count, static_cast<std::uint64_t>(size[axis]), &count))
            return fail(ErrorCode::TooLarge, fmt::format("a grid of {} x {} x {} has more than 2^64 voxels",
                                                         size.x, size.y, size.z));
    }
    return count;
}

glm::dmat4 indexFromPatient(const Grid& grid) {
    const ScaledColumns columns = scaledColumns(grid.patientFromIndex);
    const glm::dmat3 inverseUnit = glm::inverse(columns.unit);
    glm::dmat3 linear;
    for (int column = 0; column < 3; ++column) linear[column] = inverseUnit[column] / columns.length;
    glm::dmat4 result(linear);
    result[3] = glm::dvec4(-(linear * glm::dvec3(grid.patientFromIndex[3])), 1.0);
    return result;
}

glm::dmat4 textureFromIndex(const Grid& grid) {
    glm::dmat4 result(1.0);
    for (int axis = 0; axis < 3; ++axis) {
        result[axis][axis] = 1.0 / grid.size[axis];
        result[3][axis] = 0.5 / grid.size[axis];
    }
    return result;
}

glm::dmat4 textureFromPatient(const Grid& grid) {
    return textureFromIndex(grid) * indexFromPatient(grid);
}

glm::dmat4 patientFromTexture(const Grid& grid) {
    glm::dmat4 indexFromTexture(1.0);
    for (int axis = 0; axis < 3; ++axis) {
        indexFromTexture[axis][axis] = grid.size[axis];
        indexFromTexture[3][axis] = -0.5;
    }
    return grid.patientFromIndex * indexFromTexture;
}

glm::dvec3 transformPoint(const glm::dmat4& matrix, glm::dvec3 point) {
    return glm::dvec3(matrix * glm::dvec4(point, 1.0));
}

glm::dvec3 transformVector(const glm::dmat4& matrix, glm::dvec3 vector) {
    return glm::dvec3(matrix * glm::dvec4(vector, 0.0));
}

glm::dvec3 spacingMm(const Grid& grid) {
    return scaledColumns(grid.patientFromIndex).length;
}

double meanSpacingMm(const Grid& grid) {
    const glm::dvec3 spacing = spacingMm(grid);
    return (spacing.x + spacing.y + spacing.z) / 3.0;
}

double smallestSpacingMm(const Grid& grid) {
    const glm::dvec3 spacing = spacingMm(grid);
    return std::min({spacing.x, spacing.y, spacing.z});
}

glm::dvec3 centreMm(const Grid& grid) {
    return transformPoint(grid.patientFromIndex, (glm::dvec3(grid.size) - 1.0) / 2.0);
}

std::array<glm::dvec3, 8> cornersMm(const Grid& grid) {
    std::array<glm::dvec3, 8> corners{};
    for (unsigned corner = 0; corner < 8; ++corner) {
        glm::dvec3 index{-0.5};
        for (int axis = 0; axis < 3; ++axis)
            if ((corner >> axis) & 1u) index[axis] = grid.size[axis] - 0.5;
        corners[corner] = transformPoint(grid.patientFromIndex, index);
    }
    return corners;
}

double radiusMm(const Grid& grid) {
    // Half diagonals without the origin, so that a volume far away loses no digits.
    double radius = 0.0;
    for (unsigned corner = 0; corner < 4; ++corner) {
        glm::dvec3 half = glm::dvec3(grid.size) / 2.0;
        if (corner & 1u) half.x = -half.x;
        if (corner & 2u) half.y = -half.y;
        const glm::dvec3 diagonal = transformVector(grid.patientFromIndex, half);
        radius = std::max(radius, std::hypot(diagonal.x, diagonal.y, diagonal.z));
    }
    return radius;
}

bool isSheared(const Grid& grid, double tolerance) {
    const glm::dmat3 unit = scaledColumns(grid.patientFromIndex).unit;
    return std::abs(glm::dot(unit[0], unit[1])) > tolerance ||
           std::abs(glm::dot(unit[1], unit[2])) > tolerance ||
           std::abs(glm::dot(unit[2], unit[0])) > tolerance;
}

std::string orientationLetters(glm::dvec3 directionMm) {
    const double length = std::hypot(directionMm.x, directionMm.y, directionMm.z);
    if (!std::isfinite(length) || length == 0.0) return {};
    std::array<int, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return std::abs(directionMm[a]) > std::abs(directionMm[b]); });
    std::string letters;
    for (const int axis : order) {
        const double cosine = directionMm[axis] / length;
        if (letters.empty() || std::abs(cosine) > 0.2) letters += cosine > 0.0 ? "LPS"[axis] : "RAI"[axis];
    }
    return letters;
}

}  // namespace pellucid
