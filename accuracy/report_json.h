// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "accuracy/report_analysis.h"
#include "accuracy/report_data.h"

namespace pellucid::accuracy {

/// All times, and what follows from them, are members named "time": the rest of two reports of one scene is
/// equal.
[[nodiscard]] nlohmann::json reportJson(const ReportData& data, const ReportAnalysis& analysis);

/// One row a measurement, comma-separated, the first row names the columns.
[[nodiscard]] std::string reportCsv(const ReportData& data, const ReportAnalysis& analysis);

[[nodiscard]] nlohmann::json measurementJson(const Measurement& measurement);
/// Nothing when a member is missing or unknown.
[[nodiscard]] std::optional<Measurement> measurementFromJson(const nlohmann::json& json);
[[nodiscard]] nlohmann::json stallsJson(const std::vector<Stall>& stalls);
[[nodiscard]] std::vector<Stall> stallsFromJson(const nlohmann::json& json);

}  // namespace pellucid::accuracy
