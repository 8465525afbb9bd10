// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/opened_scan.h"

#include <fmt/format.h>

#include "app/desktop/view_scenes.h"
#include "io/scene_file.h"
#include "scene/presets.h"

namespace pellucid::app {

namespace {
constexpr int kHistogramBins = 512;
}

Result<OpenedScan> scanFrom(const Scene& scene, std::vector<VolumePtr> volumes, const Progress& progress) {
    for (std::size_t i = 0; i < scene.volumes.size(); ++i)
        if (const int asked = scene.volumes[i].component; asked < 0 || asked >= volumes[i]->components())
            return fail(ErrorCode::InvalidArgument,
                        fmt::format("/volumes/{}/component: found {}, the volume has {} (counted from 0).", i,
                                    asked, volumes[i]->components()));
    OpenedScan scan;
    scan.scene = scene;
    // What follows from the voxels is looked up once, here; lights and camera stay unset so that they go on
    // following the mode.
    scan.scene.volumes = completed(scene, volumes).volumes;
    const int component = scan.scene.volumes.front().component;
    auto histogram = computeHistogram(*volumes.front(), component, kHistogramBins, progress);
    if (!histogram) return fail(histogram.error(), "counting values");
    scan.histogram = std::move(*histogram);
    scan.dataFunction = defaultTransferFunction(*volumes.front(), component);
    scan.volumes = std::move(volumes);
    return scan;
}

Result<OpenedScan> openScan(const std::vector<std::filesystem::path>& paths, const io::LoadOptions& options) {
    auto loaded = io::open(paths, options);
    if (!loaded) return tl::unexpected(loaded.error());
    if (loaded->volumes.empty())
        return fail(ErrorCode::InvalidArgument, "The scene names no volume, so there is nothing to show.");
    auto scan = scanFrom(loaded->scene, std::move(loaded->volumes), options.progress);
    if (scan) scan->paths = paths;
    return scan;
}

std::string scanInformation(const Volume& volume) {
    std::string text;
    const auto line = [&](std::string_view label, const std::string& value) {
        text += fmt::format("{:<22}{}\n", label, value);
    };
    for (const Warning& warning : volume.info().warnings) line("warning", warning.message);
    const ValueRange range = volume.physicalRange();
    line("name", volume.info().name);
    line("centre", positionText(centreMm(volume.grid())));
    line("values", fmt::format("{:.6g} to {:.6g} {}", range.lo, range.hi, volume.mapping().unit));
    for (const auto& [label, value] : volume.info().facts) line(label, value);
    return text;
}

}  // namespace pellucid::app
