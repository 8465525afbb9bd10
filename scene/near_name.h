// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace pellucid {

/// The name a person most likely meant: least edits (Levenshtein 1966, case ignored), at most a third of the
/// letters or two; a name that begins with the text counts as one edit away. Nothing when none is that near;
/// the first of equally near ones.
[[nodiscard]] std::optional<std::string> nearestName(std::string_view text,
                                                     std::span<const std::string> names);

}  // namespace pellucid
