// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/image.h"

#include <array>
#include <cmath>

#include "scene/check.h"

namespace pellucid {

namespace {

/// The 8x8 threshold matrix in 64ths: bit-reversed interleaving of x xor y and y.
constexpr std::array<std::array<int, 8>, 8> bayerMatrix() {
    std::array<std::array<int, 8>, 8> matrix{};
    for (unsigned y = 0; y < 8; ++y) {
        for (unsigned x = 0; x < 8; ++x) {
            unsigned value = 0;
            for (unsigned bit = 0; bit < 3; ++bit)
                value = (value << 2) | ((((x ^ y) >> bit) & 1u) << 1) | ((y >> bit) & 1u);
            matrix[y][x] = static_cast<int>(value);
        }
    }
    return matrix;
}
constexpr auto kBayer = bayerMatrix();

std::uint8_t quantiseOne(double value, double threshold) {
    if (!(value > 0.0)) return 0;  // Also NaN.
    if (value >= 1.0) return 255;
    return static_cast<std::uint8_t>(value * 255.0 + threshold);
}

}  // namespace

Image8 quantise(const ImageF& image, bool transparent, bool dither) {
    PELLUCID_CHECK_EQ(image.pixels.size(),
                      static_cast<std::size_t>(image.size.x) * static_cast<std::size_t>(image.size.y));
    Image8 result;
    result.size = image.size;
    result.channels = transparent ? 4 : 3;
    result.bytes.reserve(image.pixels.size() * static_cast<std::size_t>(result.channels));
    for (int y = 0; y < image.size.y; ++y) {
        for (int x = 0; x < image.size.x; ++x) {
            const glm::dvec4 pixel(image.at(x, y));
            const double threshold = dither ? (kBayer[y & 7][x & 7] + 0.5) / 64.0 : 0.5;
            // Files store colour without its alpha; where nothing is, there is no colour to recover.
            const double scale = !transparent ? 1.0 : pixel.a > 0.0 ? 1.0 / pixel.a : 0.0;
            for (int c = 0; c < 3; ++c) result.bytes.push_back(quantiseOne(pixel[c] * scale, threshold));
            if (transparent) result.bytes.push_back(quantiseOne(pixel.a, threshold));
        }
    }
    return result;
}

double linearFromDisplay(double encoded) {
    const double x = std::abs(encoded);
    return std::copysign(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4), encoded);
}

glm::dvec3 linearFromDisplay(glm::dvec3 encoded) {
    return {linearFromDisplay(encoded.r), linearFromDisplay(encoded.g), linearFromDisplay(encoded.b)};
}

double displayFromLinear(double linear) {
    const double x = std::abs(linear);
    return std::copysign(x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055, linear);
}

}  // namespace pellucid
