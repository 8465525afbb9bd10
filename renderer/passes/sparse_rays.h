// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "renderer/passes/tiles.h"
#include "scene/image.h"
#include "scene/scene.h"

/// Fewer rays than pixels (Engel et al. 2006, section 8.8): rays at every fourth pixel, then at every second
/// and at every one only in the tiles where interpolation between them would show. Pure; rows bottom first.
namespace pellucid::renderer {

/// Rays at a regular grid of pixels: site (i, j) is the pixel origin + stride * (i, j), which may lie outside
/// the picture.
struct Lattice {
    int stride = 1;
    int origin = 0;  ///< Of both axes.
    glm::ivec2 size{0, 0};
    std::vector<glm::vec4> sites;  ///< Row by row; empty until drawn.

    [[nodiscard]] std::size_t index(int i, int j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(i);
    }
};

/// The coarse, middle and fine lattice (strides 4, 2 and 1) of a picture; the fine one is its pixels, the
/// others reach as far beyond as interpolation asks.
struct Lattices {
    Lattice coarse, middle, fine;
};
[[nodiscard]] Lattices latticesOf(glm::ivec2 picture);

/// Whether a picture is large enough for fewer rays to save any, and all lattices fit into its target.
[[nodiscard]] bool isSparse(glm::ivec2 picture, glm::ivec2 target);

/// The next finer lattice from the sites of `coarse`: known sites are kept, those between are interpolated by
/// the cubic through four neighbours, weights (-1, 9, 9, -1) / 16 along each axis; what overshoots [0, 1] is
/// cut where the four do not.
void interpolate(const Lattice& coarse, Lattice& fine);

/// Edge of the tiles that are decided on together, pixels.
inline constexpr int kSparseTile = 16;

/// One decision for each tile, row by row from the bottom.
struct TileChoice {
    glm::ivec2 count{0, 0};                 ///< Tiles across and up.
    std::vector<std::uint8_t> traceMiddle;  ///< 1: rays at every second pixel.
    std::vector<std::uint8_t> traceFine;    ///< 1: a ray a pixel.
};

/// Chooses tiles so that what interpolation adds to the picture's error stays about below `tolerance`
/// (display units) in `norm`. How wrong interpolation at one stride is, is found from how well sites predict
/// those between them at twice the stride, carried over by the order seen from four times to twice.
class SparseRays {
public:
    SparseRays(glm::ivec2 picture, double tolerance, ErrorNorm norm);

    /// Tiles to be traced once the coarse lattice is drawn.
    [[nodiscard]] const TileChoice& afterCoarse(const Lattice& coarse);
    /// The same with tiles added that need a ray a pixel after all: `middle` where rays at every second pixel
    /// were traced, `interpolated` the same lattice from the coarse one alone.
    [[nodiscard]] const TileChoice& afterMiddle(const Lattice& middle, const Lattice& interpolated);

private:
    struct Estimate {
        double previous = 0.0;  ///< Seen at twice the stride.
        double error = 0.0;     ///< Of interpolation at this stride, in the norm, over the tile.
        double gain = 1.0;      ///< Error at half the stride, as a part of this one.
    };
    [[nodiscard]] std::size_t tileIndex(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(m_choice.count.x) +
               static_cast<std::size_t>(x);
    }
    /// Of every tile. The gain is that of the tile and its eight neighbours: of one tile alone it is seen at
    /// few sites, and the tiles with the smallest errors would be those whose gain is too small by accident.
    void estimate(const Lattice& coarse);
    /// Takes the smallest errors within a part of what is left of the budget; gives the largest error taken.
    double keepSmallest(std::vector<std::pair<double, std::size_t>> errors, double part,
                        std::vector<std::uint8_t>& others);

    double m_tolerance;
    ErrorNorm m_norm;
    double m_budget;  ///< Squared errors that kept tiles may still add up to (Rmse).
    std::vector<Estimate> m_estimates;
    TileChoice m_choice;
};

/// The chosen tiles as rectangles of sites of `lattice`, neighbours along a row joined, clipped to it.
[[nodiscard]] std::vector<Tile> runsOf(glm::ivec2 tileCount, const std::vector<std::uint8_t>& chosen,
                                       const Lattice& lattice);

}  // namespace pellucid::renderer
