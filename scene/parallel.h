// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "scene/progress.h"

namespace pellucid {

/// Splits [0, count) into chunks of `chunk` elements and calls work(begin, end) for each, on all cores; which
/// thread takes which chunk is open, so `work` must combine by a commutative, exact operation under its own
/// lock. Progress is asked from the calling thread only. Returns false when it was cancelled. Private to the
/// libraries.
bool forEachChunk(std::uint64_t count, std::uint64_t chunk,
                  const std::function<void(std::uint64_t begin, std::uint64_t end)>& work,
                  const Progress& progress = {}, std::string_view what = {});

}  // namespace pellucid
