// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "scene/scene.h"

namespace pellucid {

/// The JSON form, `"pellucid": 1` first. Defaults are left out, so a default scene is short; numbers are
/// written so that they read back bit for bit.
[[nodiscard]] nlohmann::ordered_json toJson(const Scene& scene);
[[nodiscard]] std::string sceneText(const Scene& scene);

/// Errors: InvalidArgument (or Corrupt for text that is not JSON, with line and column). The message names
/// the JSON pointer, what was found and what is allowed: `/camera/fovDeg: found 200, allowed is a number in
/// (0, 180)`. Unknown members are errors too, with the nearest known name suggested.
[[nodiscard]] Result<Scene> sceneFromJson(const nlohmann::json& json);
[[nodiscard]] Result<Scene> sceneFromText(std::string_view text);

/// For `--set key=value`: sets one member by a dotted path ("camera.fovDeg", "quality.stepVoxels",
/// "volumes.0.filter", "mode") to a JSON literal, or to a plain word taken as a string; the result is
/// validated as a whole.
[[nodiscard]] Result<Scene> withSetting(const Scene& scene, std::string_view dottedPath,
                                        std::string_view value);

}  // namespace pellucid
