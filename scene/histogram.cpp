// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/histogram.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

#include "scene/parallel.h"

namespace pellucid {

namespace {

/// Where physical values fall.
struct Binning {
    ValueRange range;
    double span = 0.0;  ///< hi - lo, halved with everything else when it overflows.
    double scale = 1.0;
    int bins = 1;

    Binning(ValueRange r, int n) : range(r), span(r.hi - r.lo), bins(n) {
        if (std::isfinite(span)) return;
        scale = 0.5;
        span = r.hi * scale - r.lo * scale;
    }
    [[nodiscard]] std::size_t of(double physical) const {
        if (!(span > 0.0)) return 0;
        const double fraction = (physical * scale - range.lo * scale) / span;
        return std::min(static_cast<std::size_t>(std::max(fraction, 0.0) * bins),
                        static_cast<std::size_t>(bins - 1));
    }
};

/// Counts of one chunk, added to the result under a lock.
struct Counts {
    std::vector<std::uint64_t> bins;
    std::uint64_t nonFinite = 0;
};

template <class T>
Counts countDirectly(std::span<const T> voxels, std::size_t first, std::size_t stride,
                     const ValueMapping& mapping, const Binning& binning) {
    Counts counts{std::vector<std::uint64_t>(static_cast<std::size_t>(binning.bins)), 0};
    for (std::size_t i = first; i < voxels.size(); i += stride) {
        const auto stored = static_cast<double>(voxels[i]);
        if (std::isfinite(stored))
            ++counts.bins[binning.of(mapping.physical(stored))];
        else
            ++counts.nonFinite;
    }
    return counts;
}

/// Types of at most 16 bits: the bin of every possible value is looked up, which is several times faster.
template <class T>
std::vector<std::uint32_t> binOfEveryValue(const ValueMapping& mapping, const Binning& binning) {
    std::vector<std::uint32_t> bins;
    for (int stored = std::numeric_limits<T>::lowest(); stored <= std::numeric_limits<T>::max(); ++stored)
        bins.push_back(static_cast<std::uint32_t>(binning.of(mapping.physical(stored))));
    return bins;
}

template <class T>
Counts countByTable(std::span<const T> voxels, std::size_t first, std::size_t stride,
                    const std::vector<std::uint32_t>& binOf, int bins) {
    Counts counts{std::vector<std::uint64_t>(static_cast<std::size_t>(bins)), 0};
    for (std::size_t i = first; i < voxels.size(); i += stride)
        ++counts.bins[binOf[static_cast<std::size_t>(voxels[i] - std::numeric_limits<T>::lowest())]];
    return counts;
}

}  // namespace

std::uint64_t Histogram::total() const {
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

double Histogram::quantile(double fraction) const {
    const auto sum = static_cast<double>(total());
    const double wanted = std::clamp(fraction, 0.0, 1.0) * sum;
    double below = 0.0;
    for (std::size_t bin = 0; bin < counts.size(); ++bin) {
        const auto here = static_cast<double>(counts[bin]);
        if (here > 0.0 && below + here >= wanted) {
            const double position =
                (static_cast<double>(bin) + (wanted - below) / here) / static_cast<double>(counts.size());
            return std::lerp(range.lo, range.hi, position);
        }
        below += here;
    }
    return range.lo;
}

Result<Histogram> computeHistogram(const Volume& volume, int component, int bins, const Progress& progress) {
    if (bins < 1 || bins > 65536)
        return fail(ErrorCode::InvalidArgument,
                    fmt::format("a histogram of {} bins, allowed are 1 to 65536", bins));
    if (component < 0 || component >= volume.components())
        return fail(ErrorCode::InvalidArgument,
                    fmt::format("component {} of a volume that has {}, counted from 0", component,
                                volume.components()));
    const Binning binning(volume.physicalRange(component), bins);
    Histogram histogram{binning.range, std::vector<std::uint64_t>(static_cast<std::size_t>(bins)), 0};
    std::mutex mutex;
    const bool finished = visitVoxels(volume, [&]<class T>(std::span<const T> voxels) {
        const auto stride = static_cast<std::size_t>(volume.components());
        const auto first = static_cast<std::size_t>(component);
        std::vector<std::uint32_t> table;
        if constexpr (sizeof(T) <= 2) table = binOfEveryValue<T>(volume.mapping(), binning);
        constexpr std::uint64_t kChunkVoxels = 1u << 20;
        const auto work = [&](std::uint64_t begin, std::uint64_t end) {
            const auto part = voxels.subspan(begin * stride, (end - begin) * stride);
            Counts counts;
            if constexpr (sizeof(T) <= 2)
                counts = countByTable(part, first, stride, table, bins);
            else
                counts = countDirectly(part, first, stride, volume.mapping(), binning);
            const std::lock_guard lock(mutex);
            histogram.nonFinite += counts.nonFinite;
            for (std::size_t i = 0; i < counts.bins.size(); ++i) histogram.counts[i] += counts.bins[i];
        };
        return forEachChunk(volume.voxelCount(), kChunkVoxels, work, progress, "counting values");
    });
    if (!finished) return fail(ErrorCode::Cancelled, "the histogram was cancelled");
    return histogram;
}

}  // namespace pellucid
