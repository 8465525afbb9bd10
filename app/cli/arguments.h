// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/load.h"
#include "io/scene_file.h"
#include "scene/scene.h"

/// Options that several commands share, and what they mean.
namespace pellucid::app {

/// What to read: a scene, or data with how to read them.
struct InputArguments {
    std::vector<std::string> paths;
    std::string seriesUid;
    std::string rawSize, rawType, rawEndian, rawSpacing, rawUnit;
    std::optional<int> rawComponents;
    std::optional<std::uint64_t> rawHeader;
    std::optional<double> rawSlope, rawIntercept;
};
void addInputOptions(CLI::App& command, InputArguments& arguments);

/// Changes of the scene, applied in the order: preset, view, mode, size, then each --set.
struct LookArguments {
    std::string preset, view, mode, size;
    std::vector<std::string> settings;
};
void addLookOptions(CLI::App& command, LookArguments& arguments);

/// Reads the input and applies the look. Warnings of the volumes go to stderr.
/// Errors: those of io::open and of the settings; InvalidArgument naming the option.
[[nodiscard]] Result<io::LoadedScene> openInput(const InputArguments& input, const LookArguments& look);

/// The --raw options as a layout; empty without any. Errors: InvalidArgument naming the option.
[[nodiscard]] Result<std::optional<io::RawLayout>> rawLayout(const InputArguments& arguments);

/// "512x384" to (512, 384), both at least 1. Errors: InvalidArgument naming `option`.
[[nodiscard]] Result<glm::ivec2> parseSize(std::string_view text, std::string_view option);

}  // namespace pellucid::app
