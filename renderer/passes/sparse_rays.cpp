// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/passes/sparse_rays.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace pellucid::renderer {

namespace {

/// The largest gain of half the stride that is trusted; the cubic's fourth order would be 1/16.
constexpr double kBestGain = 1.0 / 8.0;

/// Differences of colours: their root mean square over RGB, or the largest.
class Differences {
public:
    void add(const glm::vec4& a, const glm::vec4& b) {
        const glm::dvec3 d = glm::abs(glm::dvec3(a) - glm::dvec3(b));
        m_squares += glm::dot(d, d);
        m_largest = std::max({m_largest, d.r, d.g, d.b});
        m_count += 3;
    }
    void add(const Differences& others) {
        m_squares += others.m_squares;
        m_largest = std::max(m_largest, others.m_largest);
        m_count += others.m_count;
    }
    [[nodiscard]] double in(ErrorNorm norm) const {
        return norm == ErrorNorm::Max ? m_largest : std::sqrt(m_squares / std::max(m_count, 1));
    }

private:
    double m_squares = 0.0;
    double m_largest = 0.0;
    int m_count = 0;
};

glm::vec4 middleOf(const glm::vec4& a, const glm::vec4& b, const glm::vec4& c, const glm::vec4& d) {
    const glm::vec4 value = 0.5625f * (b + c) - 0.0625f * (a + d);
    const glm::vec4 cut = glm::clamp(value, 0.0f, 1.0f);
    if (value == cut) return value;
    return glm::clamp(value, glm::min(glm::vec4(0.0f), glm::min(b, c)),
                      glm::max(glm::vec4(1.0f), glm::max(b, c)));
}

/// Sites along one line, `stride` apart in memory, from a coarse line; even ones are known.
void interpolateLine(const glm::vec4* coarse, std::ptrdiff_t coarseStride, glm::vec4* fine,
                     std::ptrdiff_t fineStride, int count) {
    for (int i = 0; i < count; ++i) {
        const glm::vec4* at = coarse + (1 + i / 2) * coarseStride;
        fine[i * fineStride] =
            i % 2 == 0 ? *at : middleOf(at[-coarseStride], at[0], at[coarseStride], at[2 * coarseStride]);
    }
}

int sitesFor(int finerCount) {
    return (finerCount + 1) / 2 + 3;
}

/// How far sites of a window are from what their neighbours at `reach` and three times that predict, along
/// both axes.
Differences predictionErrors(const Lattice& lattice, glm::ivec2 lo, glm::ivec2 hi, int reach) {
    Differences differences;
    for (int axis = 0; axis < 2; ++axis) {
        const std::ptrdiff_t step = axis == 0 ? reach : std::ptrdiff_t{reach} * lattice.size.x;
        glm::ivec2 from = lo, to = hi;
        from[axis] = std::max(lo[axis], 3 * reach);
        to[axis] = std::min(hi[axis], lattice.size[axis] - 1 - 3 * reach);
        for (int j = from.y; j <= to.y; ++j)
            for (int i = from.x; i <= to.x; ++i) {
                const glm::vec4* at = &lattice.sites[lattice.index(i, j)];
                differences.add(*at, middleOf(at[-3 * step], at[-step], at[step], at[3 * step]));
            }
    }
    return differences;
}

/// First site at or after a pixel, and sites from there on that lie in a tile.
int firstSite(const Lattice& lattice, int pixel) {
    return (pixel - lattice.origin + lattice.stride - 1) / lattice.stride;
}

}  // namespace

Lattices latticesOf(glm::ivec2 picture) {
    Lattices lattices;
    const auto coarser = [](const Lattice& finer) {
        return Lattice{2 * finer.stride,
                       finer.origin - 2 * finer.stride,
                       {sitesFor(finer.size.x), sitesFor(finer.size.y)},
                       {}};
    };
    lattices.fine = {1, 0, picture, {}};
    lattices.middle = coarser(lattices.fine);
    lattices.coarse = coarser(lattices.middle);
    return lattices;
}

bool isSparse(glm::ivec2 picture, glm::ivec2 target) {
    constexpr int kSmallest = 64;
    return glm::all(glm::greaterThanEqual(picture, glm::ivec2(kSmallest))) && target == picture;
}

void interpolate(const Lattice& coarse, Lattice& fine) {
    // Along rows into a lattice as wide as the fine one and as high as the coarse one, then along columns.
    std::vector<glm::vec4> rows(static_cast<std::size_t>(fine.size.x) *
                                static_cast<std::size_t>(coarse.size.y));
    for (int j = 0; j < coarse.size.y; ++j)
        interpolateLine(&coarse.sites[coarse.index(0, j)], 1,
                        &rows[static_cast<std::size_t>(j) * static_cast<std::size_t>(fine.size.x)], 1,
                        fine.size.x);
    fine.sites.resize(static_cast<std::size_t>(fine.size.x) * static_cast<std::size_t>(fine.size.y));
    const std::ptrdiff_t width = fine.size.x;
    for (int j = 0; j < fine.size.y; ++j) {
        const glm::vec4* at = &rows[static_cast<std::size_t>(1 + j / 2) * static_cast<std::size_t>(width)];
        glm::vec4* out = &fine.sites[fine.index(0, j)];
        if (j % 2 == 0) {
            std::copy_n(at, width, out);
            continue;
        }
        for (std::ptrdiff_t i = 0; i < width; ++i)
            out[i] = middleOf(at[i - width], at[i], at[i + width], at[i + 2 * width]);
    }
}

SparseRays::SparseRays(glm::ivec2 picture, double tolerance, ErrorNorm norm)
    : m_tolerance(tolerance), m_norm(norm) {
    m_choice.count = (picture + kSparseTile - 1) / kSparseTile;
    const std::size_t tiles =
        static_cast<std::size_t>(m_choice.count.x) * static_cast<std::size_t>(m_choice.count.y);
    m_choice.traceMiddle.assign(tiles, 0);
    m_choice.traceFine.assign(tiles, 0);
    m_budget = tolerance * tolerance * static_cast<double>(tiles);
}

void SparseRays::estimate(const Lattice& coarse) {
    std::vector<Differences> previous, before;
    for (int y = 0; y < m_choice.count.y; ++y)
        for (int x = 0; x < m_choice.count.x; ++x) {
            // One site more on each side: what lies between two tiles is seen by both.
            const glm::ivec2 first(firstSite(coarse, x * kSparseTile), firstSite(coarse, y * kSparseTile));
            const glm::ivec2 last = first + kSparseTile / coarse.stride - 1;
            const glm::ivec2 lo = glm::max(first - 1, 0), hi = glm::min(last + 1, coarse.size - 1);
            previous.push_back(predictionErrors(coarse, lo, hi, 1));
            before.push_back(predictionErrors(coarse, lo, hi, 2));
        }
    for (int y = 0; y < m_choice.count.y; ++y)
        for (int x = 0; x < m_choice.count.x; ++x) {
            Differences near, far;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, m_choice.count.y - 1); ++v)
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, m_choice.count.x - 1); ++u) {
                    near.add(previous[tileIndex(u, v)]);
                    far.add(before[tileIndex(u, v)]);
                }
            Estimate estimate;
            estimate.previous = previous[tileIndex(x, y)].in(m_norm);
            estimate.gain =
                far.in(m_norm) > 0.0 ? std::clamp(near.in(m_norm) / far.in(m_norm), kBestGain, 1.0) : 1.0;
            estimate.error = estimate.previous * estimate.gain;
            m_estimates.push_back(estimate);
        }
}

double SparseRays::keepSmallest(std::vector<std::pair<double, std::size_t>> errors, double part,
                                std::vector<std::uint8_t>& others) {
    std::sort(errors.begin(), errors.end());
    double spent = 0.0, largest = 0.0;
    for (const auto& [error, tile] : errors) {
        const bool kept =
            m_norm == ErrorNorm::Max ? error <= m_tolerance : spent + error * error <= part * m_budget;
        if (!kept) {
            others[tile] = 1;
            continue;
        }
        spent += error * error;
        largest = error;
    }
    m_budget -= spent;
    return largest;
}

const TileChoice& SparseRays::afterCoarse(const Lattice& coarse) {
    estimate(coarse);
    std::vector<std::pair<double, std::size_t>> errors;
    for (const auto& [previous, error, gain] : m_estimates)
        // A kept tile is interpolated twice, and each time adds its own error.
        errors.emplace_back(error * (m_norm == ErrorNorm::Max ? 1.0 + gain : std::sqrt(1.0 + gain * gain)),
                            errors.size());
    // Half is left for the tiles of the middle lattice.
    const double kept =
        std::max(keepSmallest(errors, 0.5, m_choice.traceMiddle), std::sqrt(0.5) * m_tolerance);
    // Where half the stride would not be enough either, its rays are not traced first.
    for (std::size_t tile = 0; tile < m_estimates.size(); ++tile)
        if (m_choice.traceMiddle[tile] && m_estimates[tile].error * m_estimates[tile].gain > kept) {
            m_choice.traceMiddle[tile] = 0;
            m_choice.traceFine[tile] = 1;
        }
    return m_choice;
}

const TileChoice& SparseRays::afterMiddle(const Lattice& middle, const Lattice& interpolated) {
    std::vector<std::pair<double, std::size_t>> errors;
    for (std::size_t tile = 0; tile < m_estimates.size(); ++tile) {
        if (!m_choice.traceMiddle[tile]) continue;
        const glm::ivec2 place(static_cast<int>(tile) % m_choice.count.x,
                               static_cast<int>(tile) / m_choice.count.x);
        const glm::ivec2 lo(firstSite(middle, place.x * kSparseTile),
                            firstSite(middle, place.y * kSparseTile));
        const glm::ivec2 hi = glm::min(lo + kSparseTile / middle.stride, middle.size);
        Differences differences;
        for (int j = lo.y; j < hi.y; ++j)
            for (int i = lo.x; i < hi.x; ++i) {
                const std::size_t site = middle.index(i, j);
                differences.add(middle.sites[site], interpolated.sites[site]);
            }
        // A quarter of the sites are the coarse lattice's own and equal.
        const double seen = (m_norm == ErrorNorm::Max ? 1.0 : std::sqrt(4.0 / 3.0)) * differences.in(m_norm);
        const double before = m_estimates[tile].previous;
        const double gain = before > 0.0 ? std::clamp(seen / before, kBestGain, 1.0) : 1.0;
        errors.emplace_back(seen * gain, tile);
    }
    keepSmallest(errors, 1.0, m_choice.traceFine);
    return m_choice;
}

std::vector<Tile> runsOf(glm::ivec2 tileCount, const std::vector<std::uint8_t>& chosen,
                         const Lattice& lattice) {
    std::vector<Tile> runs;
    const int edge = kSparseTile / lattice.stride;
    for (int y = 0; y < tileCount.y; ++y)
        for (int x = 0; x < tileCount.x; ++x) {
            const auto at = [&](int column) {
                return chosen[static_cast<std::size_t>(y) * static_cast<std::size_t>(tileCount.x) +
                              static_cast<std::size_t>(column)] != 0;
            };
            if (!at(x)) continue;
            const int from = x;
            while (x + 1 < tileCount.x && at(x + 1)) ++x;
            const glm::ivec2 origin(firstSite(lattice, from * kSparseTile),
                                    firstSite(lattice, y * kSparseTile));
            const glm::ivec2 size((x + 1 - from) * edge, edge);
            runs.push_back({origin, glm::min(size, lattice.size - origin)});
        }
    return runs;
}

}  // namespace pellucid::renderer
