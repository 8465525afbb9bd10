// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/extreme.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "accuracy/reference.h"
#include "accuracy/verification.h"

namespace pellucid::accuracy {
namespace {

const char* truthName(const Truth& truth) {
    constexpr std::array<const char*, 4> kNames{"closed form", "own estimate", "reference", "refused"};
    return kNames[truth.index()];
}

bool allFinite(const ImageF& image) {
    return std::all_of(image.pixels.begin(), image.pixels.end(), [](const glm::vec4& p) {
        return std::isfinite(p.r) && std::isfinite(p.g) && std::isfinite(p.b) && std::isfinite(p.a);
    });
}

/// What every pixel should be, by its place in the picture.
using Exact = std::function<glm::dvec4(std::size_t)>;

/// The largest difference of a channel of any pixel, but for the share of pixels that may lie beyond.
double errorOf(const std::vector<glm::dvec4>& apart, double share) {
    std::vector<double> errors;
    errors.reserve(apart.size());
    for (const glm::dvec4& a : apart) {
        const glm::dvec4 size = glm::abs(a);
        errors.push_back(std::max({size.r, size.g, size.b, size.a}));
    }
    std::sort(errors.begin(), errors.end());
    const auto left = static_cast<std::size_t>(share * static_cast<double>(errors.size()));
    return errors[errors.size() - 1 - std::min(left, errors.size() - 1)];
}

double errorOf(const ImageF& image, const Exact& exact, double share) {
    std::vector<glm::dvec4> apart;
    apart.reserve(image.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        apart.push_back(glm::dvec4(image.pixels[i]) - exact(i));
    return errorOf(apart, share);
}

/// How wrong a picture of nothing but the background would be. Colours only: that a ray met the volume is no
/// picture of it.
double errorOfEmpty(const Scene& scene, std::size_t pixels, const Exact& exact, double share) {
    std::vector<glm::dvec4> apart;
    apart.reserve(pixels);
    for (std::size_t i = 0; i < pixels; ++i)
        apart.emplace_back(scene.picture.background - glm::dvec3(exact(i)), 0.0);
    return errorOf(apart, share);
}

/// Nothing when the reference does not say it well enough; the row says why.
std::optional<Exact> exactOf(const ExtremeCase& extreme, const ExtremeScene& built, ExtremeRow& row) {
    if (const auto* every = std::get_if<EveryPixel>(&extreme.truth))
        return [rgba = every->rgba](std::size_t) { return rgba; };
    if (const auto* admitted = std::get_if<Admitted>(&extreme.truth))
        return [rgba = admitted->rgba](std::size_t) { return rgba; };
    ReferenceOptions options;
    options.bound = std::max(0.05 * extreme.bound, 1e-7);
    options.maxHalvings = 4;
    auto reference = referencePicture(built.scene, {built.volume}, options);
    if (!reference) {
        row.outcome = "no reference: " + reference.error().text();
        return std::nullopt;
    }
    if (!(reference->reachedBound <= 0.25 * extreme.bound)) {
        row.outcome = fmt::format("the reference still changes by {:.2g}, more than a quarter of the bound",
                                  reference->reachedBound);
        return std::nullopt;
    }
    return [image = std::move(reference->image)](std::size_t i) { return glm::dvec4(image.pixels[i]); };
}

/// An error beyond the bound passes when the frame's own estimate has it within a factor of 2.
void judge(const renderer::Frame& frame, const ExtremeCase& extreme, ExtremeRow& row) {
    if (row.error <= row.bound) {
        row.passed = true;
        return;
    }
    row.outcome = fmt::format("the error is {:.2g}, the bound {:.2g}", row.error, row.bound);
    if (!std::holds_alternative<Admitted>(extreme.truth) || !frame.error) return;
    const double told = frame.error->maxError;
    row.outcome += fmt::format("; the frame says {:.2g}", told);
    row.passed = told >= 0.5 * row.error && told <= 2.0 * row.error;
}

void compare(const renderer::Frame& frame, const ExtremeCase& extreme, const ExtremeScene& built,
             ExtremeRow& row) {
    const auto exact = exactOf(extreme, built, row);
    if (!exact) return;
    row.error = errorOf(frame.image, *exact, extreme.shareBeyond);
    const double ofEmpty = errorOfEmpty(built.scene, frame.image.pixels.size(), *exact, extreme.shareBeyond);
    if (extreme.isEmpty && ofEmpty > extreme.bound)
        row.outcome = fmt::format("should show nothing, but what is exact differs by {:.2g}", ofEmpty);
    else if (!extreme.isEmpty && ofEmpty <= 2.0 * extreme.bound)
        row.outcome = fmt::format(
            "a row that cannot fail: an empty picture would be wrong by {:.2g}, within "
            "twice the bound",
            ofEmpty);
    else
        judge(frame, extreme, row);
}

}  // namespace

ExtremeRow verifyExtreme(renderer::Renderer& renderer, const ExtremeCase& extreme) {
    ExtremeRow row{extreme.name,  truthName(extreme.truth),
                   extreme.bound, std::numeric_limits<double>::quiet_NaN(),
                   extreme.why,   "",
                   false};
    const ExtremeScene built = extreme.build();
    renderer::RenderOptions options;
    options.estimateError = std::holds_alternative<Admitted>(extreme.truth);
    options.estimateReduction = 1;
    const auto frame = renderer.render(built.scene, {built.volume}, options);
    const auto* refused = std::get_if<Refused>(&extreme.truth);
    if (!frame) {
        row.outcome = frame.error().text();
        row.passed = refused != nullptr && row.outcome.find(refused->word) != std::string::npos;
    } else if (refused != nullptr) {
        row.outcome = "drawn, though it should be refused";
    } else if (!allFinite(frame->image)) {
        row.outcome = "the picture holds a number that is not finite";
    } else {
        compare(*frame, extreme, built, row);
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
    if (row.truth == "own estimate") line.theory = "closed form, or its error told by the frame,";
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
        fmt::format("{:<58} {:<12} {:>9} {:>9}  {}\n", "case", "held to", "bound", "error", "result");
    for (const ExtremeRow& row : rows)
        text += fmt::format("{:<58} {:<12} {:>9} {:>9}  {}{}{}\n", row.name, row.truth,
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
