// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "accuracy/report_data.h"
#include "renderer/renderer.h"

namespace pellucid::accuracy {

/// This machine, its driver and this build. What the system does not tell is "unknown".
[[nodiscard]] MachineInfo machineInfo(const renderer::Renderer::DeviceInfo& device);

/// FNV-1a, 64 bits (Fowler, Noll, Vo 1991): the same on every machine of one byte order. `seed` chains parts.
[[nodiscard]] std::uint64_t stableHash(std::span<const std::byte> bytes,
                                       std::uint64_t seed = 14695981039346656037ull);

}  // namespace pellucid::accuracy
