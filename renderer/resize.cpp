// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/resize.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <thread>

#include "scene/check.h"

namespace pellucid::renderer {

namespace {

/// The four old pixels along an axis that a new one is made of.
struct Taps {
    std::array<int, 4> at{};
    std::array<float, 4> weight{};
};

/// Centre i of `count` new pixels among `old` ones; those beyond the border repeat the outer one.
std::vector<Taps> tapsFor(int old, int count) {
    std::vector<Taps> taps(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        const double place = (i + 0.5) * old / count - 0.5;
        const int first = static_cast<int>(std::floor(place)) - 1;
        const double t = place - std::floor(place);
        Taps& tap = taps[static_cast<std::size_t>(i)];
        // Catmull-Rom, written so that the weights add up to 1.
        const double w0 = 0.5 * t * (-1.0 + t * (2.0 - t)), w1 = 1.0 + 0.5 * t * t * (-5.0 + 3.0 * t);
        const double w3 = 0.5 * t * t * (t - 1.0), w2 = 1.0 - w0 - w1 - w3;
        tap.weight = {static_cast<float>(w0), static_cast<float>(w1), static_cast<float>(w2),
                      static_cast<float>(w3)};
        for (int j = 0; j < 4; ++j) tap.at[static_cast<std::size_t>(j)] = std::clamp(first + j, 0, old - 1);
    }
    return taps;
}

float between(float value, float a, float b) {
    return std::min(std::max(value, std::min(a, b)), std::max(a, b));
}

void blend(const float* a, const float* b, const float* c, const float* d, const std::array<float, 4>& w,
           float* to) {
    for (int i = 0; i < 4; ++i)
        to[i] = between(w[0] * a[i] + w[1] * b[i] + w[2] * c[i] + w[3] * d[i], b[i], c[i]);
}

class Resizing {
public:
    Resizing(const ImageF& image, glm::ivec2 size)
        : m_image(image), m_columns(tapsFor(image.size.x, size.x)), m_rows(tapsFor(image.size.y, size.y)) {}

    /// `scratch` has room for an old row, `to` for a new one.
    void row(int y, std::vector<glm::vec4>& scratch, glm::vec4* to) const {
        const Taps& tap = m_rows[static_cast<std::size_t>(y)];
        const auto rowAt = [&](int i) { return &m_image.at(0, tap.at[static_cast<std::size_t>(i)])[0]; };
        const float *a = rowAt(0), *b = rowAt(1), *c = rowAt(2), *d = rowAt(3);
        float* column = &scratch.front()[0];
        for (int i = 0; i < 4 * m_image.size.x; i += 4)
            blend(a + i, b + i, c + i, d + i, tap.weight, column + i);
        const auto pixelAt = [&](int x) { return column + 4 * static_cast<std::ptrdiff_t>(x); };
        for (const auto& [at, weight] : m_columns) {
            blend(pixelAt(at[0]), pixelAt(at[1]), pixelAt(at[2]), pixelAt(at[3]), weight, &(*to)[0]);
            ++to;
        }
    }

private:
    const ImageF& m_image;
    std::vector<Taps> m_columns, m_rows;
};

}  // namespace

ImageF resized(const ImageF& image, glm::ivec2 size) {
    PELLUCID_CHECK(image.size.x > 0 && image.size.y > 0 && size.x > 0 && size.y > 0);
    if (image.size == size) return image;
    const Resizing resizing(image, size);
    ImageF result{
        size, std::vector<glm::vec4>(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y))};
    const auto work = [&](int begin, int end) {
        std::vector<glm::vec4> scratch(static_cast<std::size_t>(image.size.x));
        for (int y = begin; y < end; ++y) resizing.row(y, scratch, &result.at(0, y));
    };
    // A thread costs about as much as a few rows.
    constexpr int kRowsPerThread = 64;
    const int threads =
        std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 1 + size.y / kRowsPerThread);
    std::vector<std::jthread> helpers;
    for (int i = 1; i < threads; ++i)
        helpers.emplace_back(work, size.y * i / threads, size.y * (i + 1) / threads);
    work(0, size.y / threads);
    return helpers.clear(), result;
}

glm::ivec2 reducedSize(glm::ivec2 size, double reduction) {
    return {std::max(1, static_cast<int>(std::lround(size.x / reduction))),
            std::max(1, static_cast<int>(std::lround(size.y / reduction)))};
}

std::array<double, kReductions.size()> reductionErrors(const ImageF& still) {
    constexpr int kEvery = 8;
    std::array<double, kReductions.size()> errors{};
    std::vector<glm::vec4> scratch(static_cast<std::size_t>(still.size.x)), row(scratch.size());
    for (std::size_t i = 0; i < kReductions.size(); ++i) {
        const ImageF small = resized(still, reducedSize(still.size, kReductions[i]));
        if (small.size == still.size) continue;
        const Resizing enlarging(small, still.size);
        double sum = 0.0;
        int rows = 0;
        for (int y = std::min(kEvery / 2, still.size.y - 1); y < still.size.y; y += kEvery, ++rows) {
            enlarging.row(y, scratch, row.data());
            for (int x = 0; x < still.size.x; ++x) {
                const glm::dvec3 apart =
                    glm::dvec3(row[static_cast<std::size_t>(x)]) - glm::dvec3(still.at(x, y));
                sum += glm::dot(apart, apart);
            }
        }
        errors[i] = std::sqrt(sum / (3.0 * rows * still.size.x));
    }
    return errors;
}

}  // namespace pellucid::renderer
