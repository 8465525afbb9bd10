// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/plan/importance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "scene/parallel.h"

namespace pellucid::renderer {

namespace {

/// Largest absolute second differences of the voxels of a block: along x, y, z, and mixed xy, xz, yz.
using Differences = std::array<float, 6>;

/// Normals of the layers of voxels, index units per mm: a ray of unit speed crosses at most so many a mm.
std::array<glm::dvec3, 3> layerNormals(const Grid& grid) {
    const glm::dmat3 rows = glm::transpose(glm::dmat3(indexFromPatient(grid)));
    return {rows[0], rows[1], rows[2]};
}

/// The voxels of one component as parts of its range, row by row; beyond the grid the outer ones repeat.
template <class T>
class Rows {
public:
    Rows(const Volume& volume, int component, std::span<const T> voxels)
        : m_size(volume.grid().size),
          m_stride(static_cast<std::size_t>(volume.components())),
          m_first(static_cast<std::size_t>(component)),
          m_lo(volume.storedRange(component).lo),
          m_range(volume.storedRange(component).hi - m_lo),
          m_voxels(voxels) {}

    /// row[i + 1] is voxel i, for i = -1 ... size.
    void read(int y, int z, std::vector<float>& row) const {
        const auto j = static_cast<std::size_t>(std::clamp(y, 0, m_size.y - 1));
        const auto k = static_cast<std::size_t>(std::clamp(z, 0, m_size.z - 1));
        const auto width = static_cast<std::size_t>(m_size.x);
        const T* from =
            m_voxels.data() + (k * static_cast<std::size_t>(m_size.y) + j) * width * m_stride + m_first;
        row.resize(width + 2);
        for (std::size_t i = 0; i < width; ++i) {
            const auto stored = static_cast<double>(from[i * m_stride]);
            row[i + 1] = std::isfinite(stored) ? static_cast<float>((stored - m_lo) / m_range) : 0.0f;
        }
        row.front() = row[1];
        row.back() = row[width];
    }

private:
    glm::ivec3 m_size;
    std::size_t m_stride;
    std::size_t m_first;
    double m_lo;
    double m_range;
    std::span<const T> m_voxels;
};

/// The rows around one row: it, its neighbours along y and z, and the one between the later two.
struct RowStar {
    std::vector<float> here, yBefore, yAfter, zBefore, zAfter, yzAfter;
};

/// Takes the differences of one row of voxels into the blocks it belongs to.
void addRow(const RowStar& rows, std::size_t width, Differences* blocks) {
    for (std::size_t i = 0; i < width; ++i) {
        const std::size_t n = i + 1;
        const float twice = 2.0f * rows.here[n];
        const float xAfter = rows.here[n + 1];
        const Differences found{std::abs(rows.here[n - 1] - twice + xAfter),
                                std::abs(rows.yBefore[n] - twice + rows.yAfter[n]),
                                std::abs(rows.zBefore[n] - twice + rows.zAfter[n]),
                                std::abs(rows.here[n] - xAfter - rows.yAfter[n] + rows.yAfter[n + 1]),
                                std::abs(rows.here[n] - xAfter - rows.zAfter[n] + rows.zAfter[n + 1]),
                                std::abs(rows.here[n] - rows.yAfter[n] - rows.zAfter[n] + rows.yzAfter[n])};
        Differences& block = blocks[i / kBlockEdge];
        for (std::size_t d = 0; d < found.size(); ++d) block[d] = std::max(block[d], found[d]);
    }
}

std::size_t blockIndex(glm::ivec3 at, glm::ivec3 size) {
    return static_cast<std::size_t>((static_cast<std::int64_t>(at.z) * size.y + at.y) * size.x + at.x);
}

/// Differences of each block alone; empty when it was cancelled.
std::vector<Differences> differencesOf(const Volume& volume, int component, glm::ivec3 blocks,
                                       const Progress& progress) {
    std::vector<Differences> all(cellCount(blocks), Differences{});
    const glm::ivec3 size = volume.grid().size;
    const bool whole = visitVoxels(volume, [&]<class T>(std::span<const T> voxels) {
        const Rows<T> rows(volume, component, voxels);
        const auto layers = [&](std::uint64_t begin, std::uint64_t end) {
            RowStar star;
            const int from = static_cast<int>(begin) * kBlockEdge;
            const int to = std::min(static_cast<int>(end) * kBlockEdge, size.z);
            for (int z = from; z < to; ++z)
                for (int y = 0; y < size.y; ++y) {
                    rows.read(y, z, star.here);
                    rows.read(y - 1, z, star.yBefore);
                    rows.read(y + 1, z, star.yAfter);
                    rows.read(y, z - 1, star.zBefore);
                    rows.read(y, z + 1, star.zAfter);
                    rows.read(y + 1, z + 1, star.yzAfter);
                    addRow(star, static_cast<std::size_t>(size.x),
                           &all[blockIndex({0, y / kBlockEdge, z / kBlockEdge}, blocks)]);
                }
        };
        return forEachChunk(static_cast<std::uint64_t>(blocks.z), 1, layers, progress,
                            "looking where the data bend");
    });
    if (!whole) all.clear();
    return all;
}

/// The largest of a block and those next to it.
Differences around(const std::vector<Differences>& all, glm::ivec3 at, glm::ivec3 blocks) {
    Differences largest{};
    for (int k = std::max(at.z - 1, 0); k <= std::min(at.z + 1, blocks.z - 1); ++k)
        for (int j = std::max(at.y - 1, 0); j <= std::min(at.y + 1, blocks.y - 1); ++j)
            for (int i = std::max(at.x - 1, 0); i <= std::min(at.x + 1, blocks.x - 1); ++i) {
                const Differences& block = all[blockIndex({i, j, k}, blocks)];
                for (std::size_t d = 0; d < block.size(); ++d) largest[d] = std::max(largest[d], block[d]);
            }
    return largest;
}

/// Curvature: the largest row sum of the matrix |second differences| weighted with the speeds at which a ray
/// can cross layers bounds its eigenvalues, and so the second derivative in any direction. Where the axes are
/// oblique, speeds can be large together, at most by the largest eigenvalue of the normals' cosines.
class Bends {
public:
    explicit Bends(const Grid& grid) {
        const auto normals = layerNormals(grid);
        const double layer = layerMm(grid);
        for (std::size_t i = 0; i < 3; ++i) {
            m_speed[i] = glm::length(normals[i]) * layer;
            double cosines = 0.0;
            for (const auto& other : normals)
                cosines += std::abs(glm::dot(glm::normalize(normals[i]), glm::normalize(other)));
            m_oblique = std::max(m_oblique, cosines);
        }
    }

    [[nodiscard]] glm::vec2 operator()(const Differences& d) const {
        const auto pair = [&](std::size_t i, std::size_t j, float difference) {
            return m_speed[i] * m_speed[j] * static_cast<double>(difference);
        };
        const double xy = pair(0, 1, d[3]), xz = pair(0, 2, d[4]), yz = pair(1, 2, d[5]);
        const double curvature =
            std::max({pair(0, 0, d[0]) + xy + xz, xy + pair(1, 1, d[1]) + yz, xz + yz + pair(2, 2, d[2])});
        return {static_cast<float>(m_oblique * curvature), d[0] + d[1] + d[2]};
    }

private:
    std::array<double, 3> m_speed{};  ///< Layers a layer thickness, at most 1.
    double m_oblique = 1.0;
};

}  // namespace

std::uint64_t importanceBytes(const Grid& grid) {
    return cellCount(blockCount(grid.size)) * sizeof(glm::vec2);
}

double layerMm(const Grid& grid) {
    double fastest = 0.0;
    for (const auto& normal : layerNormals(grid)) fastest = std::max(fastest, glm::length(normal));
    return 1.0 / fastest;
}

double longestImportanceStepMm(const Grid& grid, Filter filter) {
    // A block reaches half a voxel before its first voxel; the B-spline's values take one voxel more.
    const double beside = fieldOf(filter) == Filter::Trilinear ? 0.5 : 1.5;
    return (kBlockEdge - beside) * layerMm(grid);
}

double importanceTolerance(const Quality& quality) {
    return 0.5 / 255.0 * toleranceGreyLevels(quality);
}

double kinkWeight(Filter filter) {
    return fieldOf(filter) == Filter::Trilinear ? 1.0 : 0.0;
}

double importanceStepMm(glm::vec2 bend, Filter filter, double tolerance, double layer, double shortest,
                        double longest) {
    const double room = std::max(8.0 * tolerance - kinkWeight(filter) * static_cast<double>(bend.y), 0.0);
    return std::clamp(layer * std::sqrt(room / std::max(static_cast<double>(bend.x), 1e-30)), shortest,
                      longest);
}

Result<ImportanceGrid> importanceOf(const Volume& volume, int component, const Progress& progress) {
    const glm::ivec3 blocks = blockCount(volume.grid().size);
    ImportanceGrid grid{blocks, std::vector<glm::vec2>(cellCount(blocks))};
    const ValueRange range = volume.storedRange(component);
    if (!(range.hi > range.lo)) return grid;  // nothing bends
    const std::vector<Differences> all = differencesOf(volume, component, blocks, progress);
    if (all.empty()) return fail(ErrorCode::Cancelled, "the search for bends was cancelled");
    const Bends bends(volume.grid());
    for (int z = 0; z < blocks.z; ++z)
        for (int y = 0; y < blocks.y; ++y)
            for (int x = 0; x < blocks.x; ++x)
                grid.bends[blockIndex({x, y, z}, blocks)] = bends(around(all, {x, y, z}, blocks));
    return grid;
}

}  // namespace pellucid::renderer
