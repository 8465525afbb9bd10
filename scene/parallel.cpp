// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/parallel.h"

#include <algorithm>
#include <atomic>
#include <system_error>
#include <thread>
#include <vector>

namespace pellucid {

bool forEachChunk(std::uint64_t count, std::uint64_t chunk,
                  const std::function<void(std::uint64_t begin, std::uint64_t end)>& work,
                  const Progress& progress, std::string_view what) {
    // Other threads may be done before this one reports: who cancels from the start is heard here.
    if (!goOn(progress, 0.0, what)) return false;
    const std::uint64_t chunks = count / chunk + (count % chunk != 0 ? 1 : 0);
    std::atomic<std::uint64_t> next{0};
    std::atomic<bool> cancelled{false};
    const auto take = [&](bool reports) {
        for (;;) {
            const std::uint64_t index = next.fetch_add(1);
            if (index >= chunks || cancelled) return;
            const std::uint64_t begin = index * chunk;
            work(begin, std::min(count, begin + chunk));
            if (reports &&
                !goOn(progress, static_cast<double>(index + 1) / static_cast<double>(chunks), what))
                cancelled = true;
        }
    };
    const std::uint64_t cores = std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::jthread> helpers;
    for (std::uint64_t i = 1; i < std::min(cores, chunks); ++i) {
        try {
            helpers.emplace_back([&] { take(false); });
        } catch (const std::system_error&) {
            break;  // No more threads to be had: the ones there are do the work.
        }
    }
    take(true);
    helpers.clear();
    return !cancelled;
}

}  // namespace pellucid
