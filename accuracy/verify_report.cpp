// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "accuracy/verification.h"
#include "accuracy/verify_scenes.h"

namespace pellucid::accuracy {
namespace {

const char* claimName(Claim claim) {
    switch (claim) {
        case Claim::Order:
            return "order";
        case Claim::AtLeast:
            return "at least";
        case Claim::Independent:
            break;
    }
    return "independent";
}

}  // namespace

std::string expectedText(const OrderRow& row) {
    if (row.claim == Claim::Independent) return fmt::format("<= {:.1e}", row.tolerance);
    return fmt::format("{}{:g} +- {:.2f}", row.claim == Claim::AtLeast ? ">= " : "", row.expected,
                       row.tolerance);
}

std::string observedText(const OrderRow& row) {
    return row.claim == Claim::Independent ? fmt::format("{:.1e}", row.observed())
                                           : fmt::format("{:.2f}", row.observed());
}

VerificationLine lineOf(const OrderRow& row) {
    VerificationLine line{fmt::format("{}: {}", row.refinement, row.mode), expectedText(row),
                          observedText(row), row.passed(), row.reason};
    for (const std::string& part : {row.integrator, row.filter})
        if (!part.empty()) line.name += ", " + part;
    if (row.rays != raysName(Rays::Oblique)) line.name += ", " + row.rays;
    line.theory = (row.claim == Claim::Independent ? "error " : "order ") + line.theory;
    return line;
}

std::string orderText(std::span<const OrderRow> rows) {
    constexpr const char* kLine = "{:<10} {:<10} {:<18} {:<16} {:<13} {:>13} {:>9} {:>9}  {}{}{}\n";
    std::string text = fmt::format(fmt::runtime(kLine), "refined", "mode", "integrator", "filter", "rays",
                                   "expected", "observed", "error", "result", "", "");
    for (const OrderRow& row : rows)
        text += fmt::format(fmt::runtime(kLine), row.refinement, row.mode,
                            row.integrator.empty() ? "-" : row.integrator, row.filter, row.rays,
                            expectedText(row), observedText(row), fmt::format("{:.1e}", row.errors.back()),
                            row.passed() ? "pass" : "FAIL", row.reason.empty() ? "" : "  ", row.reason);
    const auto failed =
        std::count_if(rows.begin(), rows.end(), [](const OrderRow& row) { return !row.passed(); });
    text += fmt::format(
        "{} rows, {} failed. \"error\" is that at the finest refinement, \"<=\" holds the largest error.\n",
        rows.size(), failed);
    return text;
}

nlohmann::ordered_json orderJson(std::span<const OrderRow> rows) {
    nlohmann::ordered_json json{{"passed", allPassed(rows)}, {"rows", nlohmann::ordered_json::array()}};
    for (const OrderRow& row : rows)
        json["rows"].push_back({{"refinement", row.refinement},
                                {"mode", row.mode},
                                {"integrator", row.integrator},
                                {"filter", row.filter},
                                {"rays", row.rays},
                                {"claim", claimName(row.claim)},
                                {"expected", row.expected},
                                {"tolerance", row.tolerance},
                                {"observed", row.observed()},
                                {"passed", row.passed()},
                                {"sizes", row.sizes},
                                {"errors", row.errors},
                                {"reason", row.reason}});
    return json;
}

}  // namespace pellucid::accuracy
