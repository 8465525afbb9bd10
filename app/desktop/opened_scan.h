// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "io/load.h"
#include "scene/histogram.h"
#include "scene/scene.h"

namespace pellucid::app {

/// All that the desktop keeps of what was opened. Made off the GUI thread.
struct OpenedScan {
    Scene scene;  ///< Every volume item with its function, window and isovalue filled in.
    std::vector<VolumePtr> volumes;
    Histogram histogram;              ///< Of the first volume's shown component.
    TransferFunction1D dataFunction;  ///< The function that follows from the data alone.
    std::vector<std::filesystem::path> paths;
};

/// Opens a scene file or data, and computes what the panels show. Errors: those of io::open.
[[nodiscard]] Result<OpenedScan> openScan(const std::vector<std::filesystem::path>& paths,
                                          const io::LoadOptions& options);

/// The same for volumes that are in memory already. Precondition: one volume for each item, or one volume and
/// no item.
[[nodiscard]] Result<OpenedScan> scanFrom(const Scene& scene, std::vector<VolumePtr> volumes,
                                          const Progress& progress = {});

/// What is known of a volume, for people: its warnings in full, place, values, and what the file says; one
/// line each.
[[nodiscard]] std::string scanInformation(const Volume& volume);

}  // namespace pellucid::app
