// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/arguments.h"

/// From a scene to picture files, as `render` and a start without a display do it.
namespace pellucid::app {

struct PictureJob {
    InputArguments input;
    LookArguments look;
    std::vector<std::filesystem::path>
        outputs;  ///< Each .png (8 bits), .npy or .pfm (float, before quantisation).
    bool estimateError = true;
};

/// True when pictures can be written to files of this name.
[[nodiscard]] bool isPictureName(const std::filesystem::path& file);

/// Loads, draws and writes; prints one line per picture with its size, time and error. Returns the exit
/// status. What can be refused is refused before anything is drawn, and nothing is left behind where drawing
/// fails.
int makePicture(const PictureJob& job);

}  // namespace pellucid::app
