// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/extreme.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "accuracy/reference.h"
#include "accuracy/verification.h"

namespace pellucid::accuracy {
namespace {

const char* truthName(const Truth& truth) {
    constexpr std::array<const char*, 4> kNames{"closed form", "reference", "refused", "bounded"};
    return kNames[truth.index()];
}

bool allFinite(const ImageF& image) {
    return std::all_of(image.pixels.begin(), image.pixels.end(), [](const glm::vec4& p) {
        return std::isfinite(p.r) && std::isfinite(p.g) && std::isfinite(p.b) && std::isfinite(p.a);
    });
}

/// Largest difference of a channel in each pixel, ascending.
std::vector<double> pixelErrors(const ImageF& image, const std::function<glm::dvec4(std::size_t)>& exact) {
    std::vector<double> errors(image.pixels.size(), 0.0);
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const glm::dvec4 apart = glm::abs(glm::dvec4(image.pixels[i]) - exact(i));
        errors[i] = std::max({apart.r, apart.g, apart.b, apart.a});
    }
    std::sort(errors.begin(), errors.end());
    return errors;
}

/// The error of all but the share of pixels that may lie beyond.
double countingError(const std::vector<double>& sorted, double share) {
    const auto left = static_cast<std::size_t>(share * static_cast<double>(sorted.size()));
    return sorted[sorted.size() - 1 - std::min(left, sorted.size() - 1)];
}

void compare(const ImageF& image, const ExtremeCase& extreme, const ExtremeScene& scene, ExtremeRow& row) {
    if (const auto* every = std::get_if<EveryPixel>(&extreme.truth)) {
        row.error =
            countingError(pixelErrors(image, [&](std::size_t) { return every->rgba; }), extreme.shareBeyond);
    } else if (const auto* range = std::get_if<Bounded>(&extreme.truth)) {
        row.error =
            countingError(pixelErrors(image,
                                      [&](std::size_t i) {
                                          return glm::clamp(glm::dvec4(image.pixels[i]),
                                                            glm::dvec4(range->lo), glm::dvec4(range->hi));
                                      }),
                          0.0);
    } else {
        ReferenceOptions options;
        options.bound = std::max(0.05 * extreme.bound, 1e-7);
        options.maxHalvings = 4;
        const auto reference = referencePicture(scene.scene, {scene.volume}, options);
        if (!reference) {
            row.outcome = "no reference: " + reference.error().text();
            return;
        }
        row.error = countingError(
            pixelErrors(image, [&](std::size_t i) { return glm::dvec4(reference->image.pixels[i]); }),
            extreme.shareBeyond);
    }
    row.passed = row.error <= extreme.bound;
    if (!row.passed) row.outcome = fmt::format("the error is {:.2g}, the bound {:.2g}", row.error, row.bound);
}

}  // namespace

ExtremeRow verifyExtreme(renderer::Renderer& renderer, const ExtremeCase& extreme) {
    ExtremeRow row{extreme.name,  truthName(extreme.truth),
                   extreme.bound, std::numeric_limits<double>::quiet_NaN(),
                   extreme.why,   "",
                   false};
    const ExtremeScene built = extreme.build();
    const auto frame = renderer.render(built.scene, {built.volume});
    const auto* refused = std::get_if<Refused>(&extreme.truth);
    if (!frame) {
        row.outcome = frame.error().text();
        row.passed = refused != nullptr && row.outcome.find(refused->word) != std::string::npos;
    } else if (refused != nullptr) {
        row.outcome = "drawn, though it should be refused";
    } else if (!allFinite(frame->image)) {
        row.outcome = "the picture holds a number that is not finite";
    } else {
        compare(frame->image, extreme, built, row);
    }
    return row;
}

Result<std::vector<ExtremeRow>> verifyExtremes(renderer::Renderer& renderer, const Progress& progress,
                                               const std::function<void(const ExtremeRow&)>& found,
                                               const std::string& named) {
    auto cases = extremeCases();
    std::erase_if(cases, [&](const ExtremeCase& c) { return c.name.find(named) == std::string::npos; });
    if (cases.empty())
        return fail(ErrorCode::InvalidArgument, fmt::format("no extreme case's name holds \"{}\"", named));
    std::vector<ExtremeRow> rows;
    for (const ExtremeCase& extreme : cases) {
        if (!goOn(progress, static_cast<double>(rows.size()) / static_cast<double>(cases.size()),
                  extreme.name))
            return fail(ErrorCode::Cancelled, "the verification was cancelled");
        rows.push_back(verifyExtreme(renderer, extreme));
        if (found) found(rows.back());
    }
    return rows;
}

VerificationLine lineOf(const ExtremeRow& row) {
    const bool isRefusal = row.truth == "refused";
    VerificationLine line{row.name, row.truth, std::isnan(row.error) ? "-" : fmt::format("{:.1e}", row.error),
                          row.passed, row.why};
    if (!isRefusal) line.theory += fmt::format(" within {:.1e}", row.bound);
    if (isRefusal && row.passed) line.observed = "refused";
    if (!row.outcome.empty()) line.reason = row.outcome + (row.why.empty() ? "" : "; ") + row.why;
    return line;
}

bool allPassed(std::span<const ExtremeRow> rows) {
    return std::all_of(rows.begin(), rows.end(), [](const ExtremeRow& row) { return row.passed; });
}

std::string extremeText(std::span<const ExtremeRow> rows) {
    std::string text =
        fmt::format("{:<58} {:<11} {:>9} {:>9}  {}\n", "case", "held to", "bound", "error", "result");
    for (const ExtremeRow& row : rows)
        text += fmt::format("{:<58} {:<11} {:>9} {:>9}  {}{}{}\n", row.name, row.truth,
                            row.truth == "refused" ? "-" : fmt::format("{:.1e}", row.bound),
                            std::isnan(row.error) ? "-" : fmt::format("{:.1e}", row.error),
                            row.passed ? "pass" : "FAIL", row.outcome.empty() ? "" : "  ", row.outcome);
    const auto failed =
        std::count_if(rows.begin(), rows.end(), [](const ExtremeRow& row) { return !row.passed; });
    text += fmt::format("{} cases, {} failed.\n", rows.size(), failed);
    return text;
}

nlohmann::ordered_json extremeJson(std::span<const ExtremeRow> rows) {
    nlohmann::ordered_json json{{"passed", allPassed(rows)}, {"rows", nlohmann::ordered_json::array()}};
    for (const ExtremeRow& row : rows)
        json["rows"].push_back({{"name", row.name},
                                {"truth", row.truth},
                                {"bound", row.bound},
                                {"error", row.error},
                                {"passed", row.passed},
                                {"why", row.why},
                                {"outcome", row.outcome}});
    return json;
}

}  // namespace pellucid::accuracy
