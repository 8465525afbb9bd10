// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string_view>

namespace pellucid {

/// Given to long work. Called with the fraction done in [0, 1] and what is being done; returning false
/// cancels, and the work then ends with ErrorCode::Cancelled. An empty function is allowed: nobody watches.
using Progress = std::function<bool(double fraction, std::string_view what)>;

/// True when the work may go on.
[[nodiscard]] inline bool goOn(const Progress& progress, double fraction, std::string_view what) {
    return !progress || progress(fraction, what);
}

}  // namespace pellucid
