// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "scene/light.h"
#include "scene/scene.h"
#include "scene/transfer_function.h"

namespace pellucid {

class JsonComplaints;

/// Parts of the JSON form that other files than scenes use too. Private to the room.
[[nodiscard]] TransferFunction1D readTransferFunction(const nlohmann::json& json, const std::string& pointer,
                                                      JsonComplaints& complaints);
[[nodiscard]] Material readMaterial(const nlohmann::json& json, const std::string& pointer,
                                    JsonComplaints& complaints);

/// The JSON form with every default written out and colours as arrays, so that a path leads to every number.
[[nodiscard]] nlohmann::ordered_json toFullJson(const Scene& scene);

}  // namespace pellucid
