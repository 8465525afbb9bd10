// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "scene/scene.h"

namespace pellucid::accuracy {

/// The continuous field that a filter makes of a voxel grid (docs/equations.md, 17), physical values in
/// double. The field is one polynomial per cell, so an evaluation names the cell: a point on the border of
/// two cells then has the value of the side it is meant on, and integrals and roots inside a cell never
/// straddle a kink or a jump.
class Field {
public:
    /// Non-finite voxels take the smallest finite stored value. Precondition: the component exists.
    Field(const Volume& volume, int component, Filter filter);

    /// A field of given voxels, i fastest.
    Field(glm::ivec3 size, Filter filter, std::vector<double> voxels);

    [[nodiscard]] const std::vector<double>& voxels() const { return m_values; }
    [[nodiscard]] glm::ivec3 size() const { return m_size; }
    /// Cells border at cellOffset() + any integer, along each axis in index space: at the voxel centres, and
    /// half-way between them for the nearest filter.
    [[nodiscard]] double cellOffset() const { return m_filter == Filter::Nearest ? 0.5 : 0.0; }
    /// The cell that holds an index-space point.
    [[nodiscard]] glm::ivec3 cellOf(glm::dvec3 index) const;

    /// Value of the cell's polynomial at an index-space point. Voxels beyond the grid repeat the outer ones.
    [[nodiscard]] double value(glm::ivec3 cell, glm::dvec3 index) const;
    /// Central differences of one voxel step along i, j, k: (f(p + e) - f(p - e)) / 2, per index unit.
    [[nodiscard]] glm::dvec3 centralDifference(glm::ivec3 cell, glm::dvec3 index) const;

private:
    [[nodiscard]] double voxel(int i, int j, int k) const;

    glm::ivec3 m_size;
    Filter m_filter;
    std::vector<double> m_values;
};

}  // namespace pellucid::accuracy
