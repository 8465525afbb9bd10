// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "scene/progress.h"
#include "scene/volume.h"

namespace pellucid {

/// Counts of physical values in equal bins over [range.lo, range.hi]; the last bin includes hi.
struct Histogram {
    ValueRange range;  ///< Physical values, lo <= hi; all in bin 0 when lo == hi.
    std::vector<std::uint64_t> counts;
    std::uint64_t nonFinite = 0;  ///< Voxels left out because they are NaN or infinite.

    [[nodiscard]] std::uint64_t total() const;
    /// The physical value below which `fraction` in [0, 1] of the counted voxels lie (linear within a bin).
    [[nodiscard]] double quantile(double fraction) const;
};

/// Over all voxels of one component and its whole physical range. Uses all cores.
/// Errors: InvalidArgument (bins outside 1..65536, component), Cancelled.
[[nodiscard]] Result<Histogram> computeHistogram(const Volume& volume, int component = 0, int bins = 256,
                                                 const Progress& progress = {});

}  // namespace pellucid
