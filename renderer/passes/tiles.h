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

/// Cuts a picture into tiles of about a wanted number of pixels, row band by row band, left to right; the
/// wanted number may change between tiles. Every pixel is covered once.
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

/// Sizes tiles by the most expensive one seen, since a picture's empty parts say nothing about its full ones.
class TileBudget {
public:
    /// `msPerPixel`: what the last picture of the kind needed at worst, or a pessimistic guess.
    TileBudget(double targetMs, double msPerPixel)
        : m_targetMs(targetMs), m_worst(0.5 * msPerPixel), m_next(msPerPixel) {}
    [[nodiscard]] double wantedPixels() const { return m_targetMs / m_next; }
    void took(double pixels, double ms);
    /// For the next picture of the kind.
    [[nodiscard]] double msPerPixel() const { return m_worst; }

private:
    double m_targetMs;
    double m_worst;
    double m_next;
};

}  // namespace pellucid::renderer
