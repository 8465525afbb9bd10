// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/presets.h"

namespace pellucid {

namespace {

/// Finite physical values of one component, sorted: all of them, or an even sample of a large volume.
/// Quantiles of it do not depend on bins, so a single outlier of 1e30 spoils nothing.
std::vector<double> sortedSample(const Volume& volume, int component) {
    constexpr std::uint64_t kSamples = 1u << 18;
    // Odd, so that it does not keep hitting one column of a grid whose size is a power of two.
    const std::uint64_t stride = std::max<std::uint64_t>(1, volume.voxelCount() / kSamples) | 1u;
    std::vector<double> values;
    visitVoxels(volume, [&](auto voxels) {
        const auto components = static_cast<std::uint64_t>(volume.components());
        for (std::uint64_t voxel = 0; voxel < volume.voxelCount(); voxel += stride) {
            const auto stored =
                static_cast<double>(voxels[voxel * components + static_cast<std::uint64_t>(component)]);
            if (std::isfinite(stored)) values.push_back(volume.mapping().physical(stored));
        }
    });
    if (values.empty()) values.push_back(volume.physicalRange(component).lo);
    std::sort(values.begin(), values.end());
    return values;
}

double quantile(std::span<const double> sorted, double fraction) {
    return sorted[static_cast<std::size_t>(fraction * static_cast<double>(sorted.size() - 1) + 0.5)];
}

/// The threshold that separates two classes best (Otsu 1979): background from what is worth showing. Works on
/// sorted values directly; among equal values only the border counts. Returns the first index of the upper
/// class, 0 when all values are equal.
std::size_t upperClassStart(std::span<const double> sorted) {
    // Centred, and scaled by the range, so that sums of large numbers neither cancel nor overflow.
    const double lo = sorted.front(), hi = sorted.back();
    const double halfSpan = hi / 2 - lo / 2;
    if (!(halfSpan > 0.0)) return 0;
    const auto unit = [&](double v) { return (v / 2 - lo / 2) / halfSpan; };
    double sumAll = 0.0;
    for (const double v : sorted) sumAll += unit(v);
    const auto n = static_cast<double>(sorted.size());
    double sumBelow = 0.0, best = -1.0;
    std::size_t bestStart = 0;
    for (std::size_t i = 1; i < sorted.size(); ++i) {
        sumBelow += unit(sorted[i - 1]);
        if (sorted[i] <= sorted[i - 1]) continue;
        const auto below = static_cast<double>(i);
        const double difference = sumBelow / below - (sumAll - sumBelow) / (n - below);
        const double between = below * (n - below) * difference * difference;
        if (between > best) {
            best = between;
            bestStart = i;
        }
    }
    return bestStart;
}

/// Said by the file, or plain from the values: formats such as NIfTI keep neither unit nor modality, but
/// hardly anything except CT has air at -1000 beside values above 200. Only the first look depends on it.
bool isHounsfield(const Volume& volume, int component) {
    if (volume.mapping().unit == "HU" || volume.info().modality == "CT") return true;
    const ValueRange range = volume.physicalRange(component);
    if (!volume.mapping().unit.empty() || !volume.info().modality.empty() || range.lo < -8192.0 ||
        range.lo > -900.0 || range.hi < 200.0 || range.hi > 65535.0)
        return false;
    const std::vector<double> sorted = sortedSample(volume, component);
    const auto air = std::upper_bound(sorted.begin(), sorted.end(), -900.0) -
                     std::lower_bound(sorted.begin(), sorted.end(), -1100.0);
    return static_cast<double>(air) > 0.02 * static_cast<double>(sorted.size());
}

/// Between the 0.1st and the 99.9th percentile; everything when nearly all values are equal.
std::span<const double> withoutOutliers(const std::vector<double>& sorted) {
    const auto cut = sorted.size() / 1000;
    const std::span<const double> middle(sorted.data() + cut, sorted.size() - 2 * cut);
    return middle.front() < middle.back() ? middle : std::span<const double>(sorted);
}

}  // namespace

TransferFunction1D defaultTransferFunction(const Volume& volume, int component) {
    if (isHounsfield(volume, component))
        if (const VolumePreset* preset = findVolumePreset("CT general")) return preset->function;
    const std::vector<double> sorted = sortedSample(volume, component);
    const auto values = withoutOutliers(sorted);
    const std::size_t start = upperClassStart(values);
    const auto shown = values.subspan(start);
    // What is below the threshold is background; from there on tissue gets denser and brighter with its share
    // of voxels.
    const double edge = start > 0 ? values[start - 1] : shown.front();
    TransferFunction1D function;
    function.name = "from the data";
    function.unit = volume.mapping().unit;
    function.points = {{edge, {0.169, 0.0, 0.0}, 0.0},
                       {quantile(shown, 0.10), {0.404, 0.145, 0.078}, extinctionFromOpacity(0.05)},
                       {quantile(shown, 0.50), {0.780, 0.608, 0.380}, extinctionFromOpacity(0.20)},
                       {quantile(shown, 0.90), {0.847, 0.835, 0.788}, extinctionFromOpacity(0.35)},
                       {quantile(shown, 1.00), {1.0, 1.0, 1.0}, extinctionFromOpacity(0.50)}};
    return function;
}

Window defaultWindow(const Volume& volume, int component) {
    if (!volume.info().windows.empty()) return volume.info().windows.front().window;
    if (isHounsfield(volume, component)) return ctWindowPresets().front().window;
    const std::vector<double> sorted = sortedSample(volume, component);
    const auto values = withoutOutliers(sorted);
    const double lo = values.front(), hi = values.back();
    const double level = lo / 2 + hi / 2;
    // A constant volume gets a window wide enough that level - width / 2 differs from level.
    const double width = std::min(hi - lo, std::numeric_limits<double>::max());
    return {level, width > 0.0 ? width : std::max(1.0, std::abs(level) * 1e-3)};
}

double defaultIsovalue(const Volume& volume, int component) {
    const ValueRange range = volume.physicalRange(component);
    // Cortical and most trabecular bone lies above 300 HU, soft tissue without contrast below.
    if (isHounsfield(volume, component) && range.lo < 300.0 && range.hi > 300.0) return 300.0;
    const std::vector<double> sorted = sortedSample(volume, component);
    const auto values = withoutOutliers(sorted);
    const std::size_t start = upperClassStart(values);
    return start > 0 ? values[start - 1] / 2 + values[start] / 2 : values.front();
}

}  // namespace pellucid
