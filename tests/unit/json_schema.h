// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace pellucid::test {

/// What is wrong with `value` by the rules of `schema`, a part of `root`; empty when nothing is. Knows the
/// keywords of JSON Schema draft-07 that the project's schemas use, and complains about any other.
std::string schemaFault(const nlohmann::json& root, const nlohmann::json& schema, const nlohmann::json& value,
                        const std::string& pointer = "");

/// The schema behind a $ref, or the schema itself.
const nlohmann::json& resolved(const nlohmann::json& root, const nlohmann::json& schema);

}  // namespace pellucid::test
