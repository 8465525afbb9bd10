// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec2.hpp>

namespace pellucid::renderer {

/// A rectangle of pixels.
struct Tile {
    glm::ivec2 origin{0, 0};
    glm::ivec2 size{0, 0};
    bool operator==(const Tile&) const = default;
};

/// Cuts a picture into tiles of about a wanted number of pixels, row band by row band, left to right; the wanted number may
/// change between tiles. Every pixel is covered once.
class TileCutter {
public:
    explicit TileCutter(glm::ivec2 size) : m_size(size) {}
    [[nodiscard]] bool done() const { return m_origin.y >= m_size.y; }
    /// Precondition: !done().
    [[nodiscard]] Tile next(double wantedPixels);

private:
    glm::ivec2 m_size;
    glm::ivec2 m_origin{0, 0};
    int m_bandHeight = 0;
};

/// Pixels of the next tile from what the last one took: aims at `targetMs`, grows at most four-fold at a time.
[[nodiscard]] double nextTilePixels(double lastPixels, double lastMs, double targetMs);

}  // namespace pellucid::renderer
