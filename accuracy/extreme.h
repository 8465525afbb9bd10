// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <glm/vec4.hpp>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "renderer/renderer.h"
#include "scene/progress.h"
#include "scene/scene.h"

namespace pellucid::accuracy {

/// What a picture of an extreme scene must be.
struct EveryPixel {
    glm::dvec4 rgba;  ///< The closed form, the same for all pixels.
};
struct AsReference {};  ///< The converged reference picture (accuracy/reference.h).
struct Refused {
    std::string word;  ///< Part of the sentence that says so.
};
struct Bounded {
    double lo = 0.0, hi = 1.0;  ///< Nothing but finite and within: the scene has no convergent answer.
};
using Truth = std::variant<EveryPixel, AsReference, Refused, Bounded>;

struct ExtremeScene {
    Scene scene;
    VolumePtr volume;
};

/// One line of the table of extreme cases.
struct ExtremeCase {
    std::string name;
    std::function<ExtremeScene()> build;
    Truth truth;
    double bound = 0.0;  ///< Largest error allowed of any channel, display units.
    std::string why;     ///< What is exact, and where the bound comes from.
    /// Share of pixels that may lie beyond the bound: edges, where a ray falls to either side.
    double shareBeyond = 0.0;
};

/// The table. docs/verification.md says how to add a case.
[[nodiscard]] std::vector<ExtremeCase> extremeCases();

struct ExtremeRow {
    std::string name;
    std::string truth;  ///< "closed form", "reference", "refused", "bounded".
    double bound = 0.0;
    double error = 0.0;  ///< Largest of any channel among the pixels that count; NaN without a picture.
    std::string why;
    std::string outcome;  ///< What went wrong, or the refusal's sentence.
    bool passed = false;
};

/// Draws every case and measures its error; a number that is not finite fails. Some 60 s on two cores.
/// `found` is given each row once it is there; `named` leaves only the cases whose name holds it. Errors:
/// Cancelled, InvalidArgument (no such case). That a case is refused, rightly or wrongly,
/// is a row.
[[nodiscard]] Result<std::vector<ExtremeRow>> verifyExtremes(
    renderer::Renderer& renderer, const Progress& progress = {},
    const std::function<void(const ExtremeRow&)>& found = {}, const std::string& named = {});
[[nodiscard]] ExtremeRow verifyExtreme(renderer::Renderer& renderer, const ExtremeCase& extreme);

[[nodiscard]] bool allPassed(std::span<const ExtremeRow> rows);
[[nodiscard]] std::string extremeText(std::span<const ExtremeRow> rows);
[[nodiscard]] nlohmann::ordered_json extremeJson(std::span<const ExtremeRow> rows);

}  // namespace pellucid::accuracy
