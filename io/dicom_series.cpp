// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/dicom_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <mutex>
#include <optional>
#include <thread>

#include "io/dicom_header.h"
#include "io/dicom_pixels.h"
#include "io/text_scan.h"
#include "scene/parallel.h"

namespace pellucid::io {
namespace {

/// Of the whole work, how much reading the headers takes.
constexpr double kHeaderShare = 0.2;

tl::unexpected<Error> cancelled() {
    return fail(ErrorCode::Cancelled, "loading was cancelled");
}

/// On all cores; of several errors that of the first file.
Result<std::vector<SliceHeader>> readHeaders(const DicomSeries& series, const Progress& progress) {
    constexpr std::uint64_t kFilesAtATime = 8;
    std::vector<std::optional<Result<SliceHeader>>> read(series.files.size());
    const Progress share = [&](double fraction, std::string_view what) {
        return goOn(progress, kHeaderShare * fraction, what);
    };
    const bool isWhole = forEachChunk(
        read.size(), kFilesAtATime,
        [&](std::uint64_t begin, std::uint64_t end) {
            for (std::uint64_t i = begin; i < end; ++i) read[i] = readSliceHeader(series.files[i]);
        },
        share, "reading DICOM headers");
    if (!isWhole) return cancelled();
    std::vector<SliceHeader> slices;
    for (auto& slice : read) {
        if (!*slice) return tl::unexpected(slice->error());
        slices.push_back(std::move(**slice));
    }
    return slices;
}

/// Below this the whole is there before anybody could have seen a copy.
constexpr std::uint64_t kLeastForCoarse = 16'000'000;

/// One of kCoarseEvery voxels along each axis, which lies where it lay. Only those slices need to be decoded.
Result<VolumePtr> coarseCopy(const Grid& grid, VoxelType type, std::span<const std::byte> voxels,
                             const ValueMapping& mapping, const VolumeInfo& info) {
    Grid coarse = grid;
    coarse.size = (grid.size + (kCoarseEvery - 1)) / kCoarseEvery;
    for (int axis = 0; axis < 3; ++axis) coarse.patientFromIndex[axis] *= kCoarseEvery;
    const std::size_t width = bytesPerComponent(type);
    std::vector<std::byte> kept(static_cast<std::size_t>(coarse.size.x) *
                                static_cast<std::size_t>(coarse.size.y) *
                                static_cast<std::size_t>(coarse.size.z) * width);
    std::byte* to = kept.data();
    for (int k = 0; k < grid.size.z; k += kCoarseEvery)
        for (int j = 0; j < grid.size.y; j += kCoarseEvery) {
            const auto row = static_cast<std::size_t>(k) * static_cast<std::size_t>(grid.size.y) +
                             static_cast<std::size_t>(j);
            const std::byte* from = voxels.data() + row * static_cast<std::size_t>(grid.size.x) * width;
            for (int i = 0; i < grid.size.x; i += kCoarseEvery, to += width)
                std::memcpy(to, from + static_cast<std::size_t>(i) * width, width);
        }
    return Volume::make(coarse, type, 1, std::move(kept), mapping, info);
}

/// Decodes the slices, ordered as in the volume, on several threads: first those of the coarse copy. Progress
/// is called on this thread only.
class Decoder {
public:
    Decoder(std::span<const SliceHeader> slices, StoredForm form, std::span<std::byte> voxels)
        : m_slices(slices), m_form(form), m_voxels(voxels), m_sliceBytes(voxels.size() / slices.size()) {}

    /// Only the slices of the coarse copy.
    Result<void> runCoarse(const Progress& progress) {
        for (std::size_t k = 0; k < m_slices.size(); k += kCoarseEvery) m_order.push_back(k);
        return runOrder(progress);
    }
    /// All that are left.
    Result<void> run(const Progress& progress) {
        const bool hasCoarse = !m_order.empty();
        m_order.clear();
        for (std::size_t k = 0; k < m_slices.size(); ++k)
            if (!hasCoarse || k % kCoarseEvery != 0) m_order.push_back(k);
        return runOrder(progress);
    }

private:
    Result<void> runOrder(const Progress& progress) {
        m_next = 0;
        const std::size_t helpers =
            std::min<std::size_t>(std::max(1u, std::thread::hardware_concurrency()), m_order.size());
        {
            std::vector<std::jthread> threads;
            for (std::size_t i = 1; i < helpers; ++i) threads.emplace_back([this] { work({}); });
            work(progress);
        }
        m_done += m_order.size();
        if (m_error) return tl::unexpected(*m_error);
        if (m_done == m_slices.size() && !goOn(progress, 1.0, "decoding slices")) return cancelled();
        return {};
    }

    void work(const Progress& progress) {
        while (!m_stop) {
            const std::size_t next = m_next++;
            if (next >= m_order.size()) return;
            const std::size_t k = m_order[next];
            const double done = static_cast<double>(m_done + next) / static_cast<double>(m_slices.size());
            if (!goOn(progress, kHeaderShare + (1.0 - kHeaderShare) * done, "decoding slices")) {
                return stop(cancelled().value());
            }
            auto decoded = decodeSlice(m_slices[k], m_form, m_voxels.subspan(k * m_sliceBytes, m_sliceBytes));
            if (!decoded) return stop(decoded.error());
        }
    }

    void stop(const Error& error) {
        const std::lock_guard lock(m_mutex);
        if (!m_error) m_error = error;
        m_stop = true;
    }

    std::span<const SliceHeader> m_slices;
    StoredForm m_form;
    std::span<std::byte> m_voxels;
    std::size_t m_sliceBytes;
    std::vector<std::size_t> m_order;  ///< The slices to decode now.
    std::size_t m_done = 0;            ///< Slices decoded before these.
    std::atomic<std::size_t> m_next{0};
    std::atomic<bool> m_stop{false};
    std::mutex m_mutex;
    std::optional<Error> m_error;
};

/// Unit of the rescaled values: PS3.3 section C.11.1.1.2; CT without a type is in Hounsfield units (section
/// C.8.2.1.1.2).
std::string unitOf(const SliceHeader& slice) {
    if (slice.rescaleType == "HU") return "HU";
    if (slice.rescaleType == "PCT") return "%";
    if (slice.rescaleType.empty() && slice.modality == "CT" && slice.hasRescale) return "HU";
    return {};
}

void addWarnings(const std::vector<SliceHeader>& slices, const StoredForm& form, VolumeInfo& info) {
    const auto warn = [&](std::string message) { info.warnings.push_back({std::move(message)}); };
    const auto [low, high] = std::minmax_element(
        slices.begin(), slices.end(),
        [](const SliceHeader& a, const SliceHeader& b) { return std::abs(a.slope) < std::abs(b.slope); });
    if (form.physical) {
        warn(fmt::format(
            "slope and intercept differ between slices (slope from {:.9g} to {:.9g}): the values were "
            "converted to float32, rounded by up to 1 part in 16 million",
            low->slope, high->slope));
    }
    if (slices.front().photometric == "MONOCHROME1") {
        warn("MONOCHROME1: the file means large values to be shown dark; they are kept as they are");
    }
    if (slices.front().modality == "CT" && !slices.front().hasRescale) {
        warn("a CT without rescale slope and intercept: its values are not in Hounsfield units");
    }
    for (const auto& lossy : {"Baseline", "Extended", "Spectral", "Progression", "JPEG-LS Lossy", "Near"}) {
        if (slices.front().transferSyntax.find(lossy) == std::string::npos) continue;
        warn(fmt::format("compressed with loss ({}): values are not as acquired",
                         slices.front().transferSyntax));
        break;
    }
}

std::vector<std::pair<std::string, std::string>> factsOf(const std::vector<SliceHeader>& slices,
                                                         const Grid& grid, const SeriesGeometry& geometry) {
    const SliceHeader& first = slices.front();
    const SlicePlacement& place = first.placement;
    std::vector<std::pair<std::string, std::string>> facts{
        {"Series", first.description},
        {"Files", fmt::format("{}", slices.size())},
        {"Transfer syntax", first.transferSyntax},
        {"Size", fmt::format("{} x {} x {}", grid.size.x, grid.size.y, grid.size.z)},
        {"Spacing",
         fmt::format("{:.6g} x {:.6g} mm in the slice, {:.6g} mm between slices along their normal",
                     place.spacingMm.x, place.spacingMm.y, geometry.stepMm)},
        {"Stored", fmt::format("{} of {} bits, {}", first.pixels.bitsStored, first.pixels.bitsAllocated,
                               first.pixels.isSigned ? "signed" : "unsigned")},
        {"Rescale", fmt::format("slope {:.9g}, intercept {:.9g}{}{}", first.slope, first.intercept,
                                first.rescaleType.empty() ? "" : ", type ", first.rescaleType)}};
    if (geometry.tiltDeg > 0.05)
        facts.emplace_back("Gantry tilt", fmt::format("{:.2f} degrees", geometry.tiltDeg));
    if (place.thicknessMm)
        facts.emplace_back("Slice thickness", fmt::format("{:.6g} mm", *place.thicknessMm));
    if (!first.paddingValue.empty()) facts.emplace_back("Pixel padding value", first.paddingValue);
    return facts;
}

VolumeInfo infoOf(const std::vector<SliceHeader>& slices, const Grid& grid, const SeriesGeometry& geometry,
                  const StoredForm& form, const DicomSeries& series) {
    VolumeInfo info;
    const SliceHeader& middle =
        slices[slices.size() / 2];  // Windows differ by slice in MR; the middle shows most.
    info.name = series.description.empty() ? series.modality + " series" : series.description;
    info.modality = middle.modality;
    info.windows = middle.windows;
    info.warnings = geometry.warnings;
    addWarnings(slices, form, info);
    info.warnings.insert(info.warnings.end(), series.warnings.begin(), series.warnings.end());
    info.facts = factsOf(slices, grid, geometry);
    return info;
}

}  // namespace

Result<VolumePtr> loadDicomSeries(const DicomSeries& series, const LoadOptions& options) {
    if (series.files.empty())
        return fail(ErrorCode::InvalidArgument, "a series without files cannot be loaded");
    auto headers = readHeaders(series, options.progress);
    if (!headers) return tl::unexpected(headers.error());
    std::vector<SlicePlacement> placements;
    for (const SliceHeader& header : *headers) placements.push_back(header.placement);
    const auto geometry = placeSlices(placements);
    if (!geometry) {
        return fail(geometry.error(),
                    fmt::format("series \"{}\"",
                                series.description.empty() ? shown(series.uid, 64) : series.description));
    }
    std::vector<SliceHeader> slices;
    for (const std::size_t index : geometry->order) slices.push_back(std::move((*headers)[index]));

    const StoredForm form = storedForm(slices);
    Grid grid;
    grid.size = {placements.front().size, static_cast<int>(slices.size())};
    grid.patientFromIndex = geometry->patientFromIndex;
    const auto count = checkedVoxelCount(grid.size);
    if (!count) return tl::unexpected(count.error());
    const std::uint64_t width = bytesPerComponent(form.type);
    if (*count > options.maxVoxelBytes / width) {
        return fail(ErrorCode::TooLarge,
                    fmt::format("{} x {} x {} voxels of {} bytes are more than the limit of {} bytes",
                                grid.size.x, grid.size.y, grid.size.z, width, options.maxVoxelBytes));
    }
    // Each file was seen to be able to hold its slice, so this is bounded by what is on disk.
    std::vector<std::byte> voxels(static_cast<std::size_t>(*count * width));
    const VolumeInfo info = infoOf(slices, grid, *geometry, form, series);
    const ValueMapping mapping =
        form.physical ? ValueMapping{1.0, 0.0, unitOf(slices.front())}
                      : ValueMapping{slices.front().slope, slices.front().intercept, unitOf(slices.front())};
    Decoder decoder(slices, form, voxels);
    if (options.coarse && *count >= kLeastForCoarse) {
        if (auto decoded = decoder.runCoarse(options.progress); !decoded)
            return tl::unexpected(decoded.error());
        // What is wrong with the values is said when all are there.
        if (auto coarse = coarseCopy(grid, form.type, voxels, mapping, info))
            options.coarse(std::move(*coarse));
    }
    if (auto decoded = decoder.run(options.progress); !decoded) return tl::unexpected(decoded.error());
    return Volume::make(grid, form.type, 1, std::move(voxels), mapping, info);
}

Result<VolumePtr> loadDicom(const std::vector<std::filesystem::path>& paths, const LoadOptions& options) {
    constexpr double kScanShare = 0.2;
    const Progress scanning = [&](double fraction, std::string_view what) {
        return goOn(options.progress, kScanShare * fraction, what);
    };
    const auto scan = scanDicom(paths, scanning);
    if (!scan) return tl::unexpected(scan.error());
    const auto series = chooseSeries(*scan, options.seriesUid);
    if (!series) return tl::unexpected(series.error());
    LoadOptions rest = options;
    rest.progress = [&](double fraction, std::string_view what) {
        return goOn(options.progress, kScanShare + (1.0 - kScanShare) * fraction, what);
    };
    return loadDicomSeries(*series, rest);
}

}  // namespace pellucid::io
