// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "renderer/plan/volume_format.h"

namespace pellucid::renderer {

/// A stored value as an R16 texel, exactly: u = texel / 65535 and stored = u * scale + offset of
/// storedFromTexel().
inline std::uint16_t texel16(std::uint8_t v) {
    return static_cast<std::uint16_t>(v * 257);
}
inline std::uint16_t texel16(std::int8_t v) {
    return static_cast<std::uint16_t>((v + 128) * 257);
}
inline std::uint16_t texel16(std::uint16_t v) {
    return v;
}
inline std::uint16_t texel16(std::int16_t v) {
    return static_cast<std::uint16_t>(v + 32768);
}

/// Everything else as float over its range; what is not finite as the smallest finite value.
struct FloatTexel {
    StoredFromTexel map;
    template <class T>
    float operator()(T v) const {
        const double stored = static_cast<double>(v);
        return std::isfinite(stored) ? static_cast<float>((stored - map.offset) / map.scale) : 0.0f;
    }
};

}  // namespace pellucid::renderer
