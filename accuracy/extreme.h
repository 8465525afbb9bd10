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
/// A closed form that the scene's rule may miss by its nature, but not silently.
struct Admitted {
    glm::dvec4 rgba;  ///< The same for all pixels.
};
struct AsReference {};  ///< The converged reference picture (accuracy/reference.h).
struct Refused {
    std::string word;  ///< Part of the sentence that says so.
};
using Truth = std::variant<EveryPixel, Admitted, AsReference, Refused>;

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
    /// Meant to show nothing but the background. In every other case a picture of the background alone must
    /// be wrong by more than twice the bound, else the row could not fail and is one that fails.
    bool isEmpty = false;
};

/// The table. docs/verification.md says how to add a case.
[[nodiscard]] std::vector<ExtremeCase> extremeCases();

struct ExtremeRow {
    std::string name;
    std::string truth;  ///< "closed form", "own estimate", "reference", "refused".
    double bound = 0.0;
    double error = 0.0;  ///< Largest of any channel among the pixels that count; NaN without a picture.
    std::string why;
    std::string outcome;  ///< What went wrong, or the refusal's sentence.
    bool passed = false;
};

/// Draws every case and measures its error; a number that is not finite fails. Some 10 s on two cores.
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
