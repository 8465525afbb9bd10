// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "accuracy/report_analysis.h"
#include "accuracy/report_svg.h"

namespace pellucid::accuracy {

/// A plot and what is said above and below it.
struct ReportFigure {
    std::string title;
    std::string text;  ///< HTML.
    Plot plot;
};

/// Error over time of the integrators, error over step, formats, filters and jitter; each left out where
/// nothing was measured for it.
[[nodiscard]] std::vector<ReportFigure> reportFigures(const ReportData& data, const ReportAnalysis& analysis);

}  // namespace pellucid::accuracy
