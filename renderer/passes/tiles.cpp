// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/passes/tiles.h"

#include <algorithm>
#include <cmath>

namespace pellucid::renderer {

Tile TileCutter::next(double wantedPixels) {
    // Software rasterisers share out blocks of 64 x 64 pixels: a multiple of it in each direction keeps all cores busy.
    constexpr int kBlock = 64;
    const auto rounded = [](double pixels, int limit) {
        const int blocks = static_cast<int>(std::min(pixels, 1e9)) / kBlock * kBlock;
        return std::clamp(blocks > 0 ? blocks : static_cast<int>(pixels), 1, limit);
    };
    if (m_origin.x == 0) {
        const double rows = wantedPixels / m_size.x;
        // Less than a block of rows: keep the tile square rather than a thin strip.
        const double height = rows >= kBlock ? rows : std::clamp(std::sqrt(wantedPixels), 1.0, static_cast<double>(kBlock));
        m_bandHeight = rounded(height, m_size.y - m_origin.y);
    }
    const int width = rounded(wantedPixels / m_bandHeight, m_size.x - m_origin.x);
    const Tile tile{m_origin, {width, m_bandHeight}};
    m_origin.x += width;
    if (m_origin.x >= m_size.x) m_origin = {0, m_origin.y + m_bandHeight};
    return tile;
}

void TileBudget::took(double pixels, double ms) {
    m_worst = std::max(m_worst, ms / pixels);
    m_next = m_worst;
}

}  // namespace pellucid::renderer
