// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace pellucid {

/// Float picture, row 0 at the top, RGBA. RGB are in units of what is shown (display-encoded, [0, 1] is the
/// displayable range, not clamped) with the background composited in; A is the opacity of the volume, 1 - T.
/// With a transparent background RGB is associated with A.
struct ImageF {
    glm::ivec2 size{0, 0};
    std::vector<glm::vec4> pixels;

    [[nodiscard]] const glm::vec4& at(int x, int y) const {
        return pixels[static_cast<std::size_t>(y) * size.x + x];
    }
    [[nodiscard]] glm::vec4& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * size.x + x]; }
    bool operator==(const ImageF&) const = default;
};

/// 8-bit picture, row 0 at the top, 3 (RGB) or 4 (RGBA, not associated) bytes a pixel.
struct Image8 {
    glm::ivec2 size{0, 0};
    int channels = 3;
    std::vector<std::uint8_t> bytes;
    bool operator==(const Image8&) const = default;
};

/// The only quantisation in the program: clamp, round to nearest; NaN becomes 0. With dither, a fixed 8x8
/// Bayer threshold (Bayer 1973) is used instead of one half, so the mean is kept and the same picture gives
/// the same bytes. A transparent picture gives RGBA.
[[nodiscard]] Image8 quantise(const ImageF& image, bool transparent, bool dither);

/// IEC 61966-2-1 (sRGB) in float; identity-safe outside [0, 1] (mirrored below 0, continued above 1).
[[nodiscard]] double linearFromDisplay(double encoded);
/// The same for each channel.
[[nodiscard]] glm::dvec3 linearFromDisplay(glm::dvec3 encoded);
[[nodiscard]] double displayFromLinear(double linear);

}  // namespace pellucid
