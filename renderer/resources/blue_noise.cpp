// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/resources/blue_noise.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace pellucid::renderer {

namespace {

/// Points on a torus with the Gaussian density they make everywhere.
class PointSet {
public:
    explicit PointSet(int size)
        : m_size(size),
          m_isSet(static_cast<std::size_t>(size * size)),
          m_density(m_isSet.size()),
          m_kernel(m_isSet.size()) {
        constexpr double kSigma = 1.5;  // Ulichney's choice
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const double dx = std::min(x, size - x), dy = std::min(y, size - y);
                m_kernel[static_cast<std::size_t>(y * size + x)] =
                    std::exp(-(dx * dx + dy * dy) / (2.0 * kSigma * kSigma));
            }
    }

    [[nodiscard]] bool has(std::size_t at) const { return m_isSet[at]; }

    void flip(std::size_t at) {
        const double sign = m_isSet[at] ? -1.0 : 1.0;
        m_isSet[at] = !m_isSet[at];
        const int ax = static_cast<int>(at) % m_size, ay = static_cast<int>(at) / m_size;
        for (int y = 0; y < m_size; ++y)
            for (int x = 0; x < m_size; ++x) {
                const int kx = (x - ax) & (m_size - 1), ky = (y - ay) & (m_size - 1);
                m_density[static_cast<std::size_t>(y * m_size + x)] +=
                    sign * m_kernel[static_cast<std::size_t>(ky * m_size + kx)];
            }
    }

    /// The point with most others around it, or the free place with fewest.
    [[nodiscard]] std::size_t tightestCluster() const {
        return best(true, [](double a, double b) { return a > b; });
    }
    [[nodiscard]] std::size_t largestVoid() const {
        return best(false, [](double a, double b) { return a < b; });
    }

private:
    template <class Better>
    [[nodiscard]] std::size_t best(bool among, const Better& better) const {
        std::size_t found = m_isSet.size();
        for (std::size_t i = 0; i < m_isSet.size(); ++i)
            if (m_isSet[i] == among && (found == m_isSet.size() || better(m_density[i], m_density[found])))
                found = i;
        return found;
    }

    int m_size;
    std::vector<bool> m_isSet;
    std::vector<double> m_density;
    std::vector<double> m_kernel;
};

PointSet evenStart(int size, std::size_t points) {
    PointSet set(size);
    std::mt19937 random(20060716);  // fixed: pictures do not change from run to run
    for (std::size_t placed = 0; placed < points;) {
        const auto at = random() % static_cast<std::size_t>(size * size);
        if (set.has(at)) continue;
        set.flip(at);
        ++placed;
    }
    // Move the tightest point to the largest void until it would come back.
    for (;;) {
        const auto from = set.tightestCluster();
        set.flip(from);
        const auto to = set.largestVoid();
        set.flip(to);
        if (to == from) return set;
    }
}

}  // namespace

std::vector<std::uint16_t> blueNoiseRanks(int size) {
    const auto total = static_cast<std::size_t>(size * size);
    const std::size_t start = total / 10;
    const PointSet even = evenStart(size, start);
    std::vector<std::uint16_t> ranks(total);
    PointSet shrinking = even;
    for (std::size_t rank = start; rank-- > 0;) {
        const auto at = shrinking.tightestCluster();
        shrinking.flip(at);
        ranks[at] = static_cast<std::uint16_t>(rank);
    }
    PointSet growing = even;
    for (std::size_t rank = start; rank < total; ++rank) {
        const auto at = growing.largestVoid();
        growing.flip(at);
        ranks[at] = static_cast<std::uint16_t>(rank);
    }
    return ranks;
}

GlTexture createBlueNoise() {
    constexpr int kSize = 64;
    std::vector<float> offsets;
    for (const auto rank : blueNoiseRanks(kSize))
        offsets.push_back((static_cast<float>(rank) + 0.5f) / (kSize * kSize));
    GlTexture texture = createTexture(GL_TEXTURE_2D);
    glTextureStorage2D(texture.id(), 1, GL_R32F, kSize, kSize);
    glTextureSubImage2D(texture.id(), 0, 0, 0, kSize, kSize, GL_RED, GL_FLOAT, offsets.data());
    return texture;
}

}  // namespace pellucid::renderer
