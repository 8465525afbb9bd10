// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "accuracy/report_analysis.h"
#include "accuracy/report_data.h"

namespace pellucid::accuracy {

/// The bytes of a picture of the report by its name (report_run.h); nothing when it is not there.
using ReadPicture = std::function<std::optional<std::string>(const std::string& name)>;

/// One page that needs nothing else: styles, plots and pictures are in it, and it runs no scripts.
[[nodiscard]] std::string reportHtml(const ReportData& data, const ReportAnalysis& analysis,
                                     const ReadPicture& readPicture);

}  // namespace pellucid::accuracy
