// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/passes/tiles.h"

#include <algorithm>

namespace pellucid::renderer {

Tile TileCutter::next(double wantedPixels) {
    // Software rasterisers give each thread blocks of 64 x 64 pixels: wide strips spread over all threads,
    // and whole blocks are not touched twice. A quad of pixels is the smallest unit everywhere.
    constexpr int kBlock = 64;
    constexpr int kThinnest = 4;
    if (m_origin.x == 0) {
        const int rows = static_cast<int>(std::min(wantedPixels / m_size.x, 1e6));
        const int height = rows >= kBlock ? rows / kBlock * kBlock : std::max(rows, kThinnest);
        m_bandHeight = std::min(height, m_size.y - m_origin.y);
    }
    const int wanted = static_cast<int>(std::min(wantedPixels / m_bandHeight, 1e6));
    // What would be left of the row is taken along when it is less than half a tile.
    const int left = m_size.x - m_origin.x;
    const int width = std::max(wanted, kThinnest) * 3 / 2 >= left ? left : std::max(wanted, kThinnest);
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
