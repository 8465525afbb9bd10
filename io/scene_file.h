// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "io/load.h"
#include "scene/scene.h"

namespace pellucid::io {

/// A scene and the volumes it names, in the order of scene.volumes.
struct LoadedScene {
    Scene scene;
    std::vector<VolumePtr> volumes;
};

/// True when the file is a scene (JSON with the member "pellucid").
[[nodiscard]] bool looksLikeScene(const std::filesystem::path& file);

/// Reads a scene file; sources are relative to its folder, and absolute in the scene that is returned.
/// "FOLDER#series=UID" names one DICOM series of a folder with several.
[[nodiscard]] Result<LoadedScene> loadScene(const std::filesystem::path& file,
                                            const LoadOptions& options = {});
/// One scene file, or data files and folders that become a scene with one volume.
[[nodiscard]] Result<LoadedScene> open(const std::vector<std::filesystem::path>& paths,
                                       const LoadOptions& options = {});
/// Writes the scene; sources become relative to the file's folder where they can.
[[nodiscard]] Result<void> saveScene(const std::filesystem::path& file, const Scene& scene);

}  // namespace pellucid::io
