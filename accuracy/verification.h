// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/extreme.h"
#include "accuracy/verify.h"

namespace pellucid::accuracy {

/// What the self-test is asked to do. Each part takes up to a minute on two cores without a graphics card.
struct VerificationParts {
    bool step = true;            ///< Orders under refinement of the step.
    bool grid = true;            ///< Of the voxel grid.
    bool pixel = true;           ///< Of the pixel.
    bool extreme = false;        ///< The stiff and extreme cases.
    std::string extremeNamed{};  ///< Only the extreme cases whose name holds this text.
};

/// What the self-test found. A suite that was not asked for is absent.
struct Verification {
    std::string program;  ///< Name and version.
    std::string driver;   ///< Vendor, device and version, as the driver names them.
    std::optional<std::vector<OrderRow>> orders{};
    std::optional<std::vector<ExtremeRow>> extremes{};

    [[nodiscard]] bool passed() const;
};

/// A row of either suite in the same five words, for whoever shows them in one table.
struct VerificationLine {
    std::string name;
    std::string theory;    ///< What it is held to.
    std::string observed;  ///< An order or an error; "-" without a picture.
    bool passed = false;
    std::string reason;  ///< Where the expectation comes from, and what went wrong.
};
[[nodiscard]] VerificationLine lineOf(const OrderRow& row);
[[nodiscard]] VerificationLine lineOf(const ExtremeRow& row);

/// Runs the parts on this renderer. `found` is given each row once it is there. Errors: Gpu, Cancelled.
[[nodiscard]] Result<Verification> verify(renderer::Renderer& renderer, const VerificationParts& parts,
                                          const Progress& progress = {},
                                          const std::function<void(const VerificationLine&)>& found = {});

/// Tables for people; and every figure.
[[nodiscard]] std::string verificationText(const Verification& verification);
[[nodiscard]] nlohmann::ordered_json verificationJson(const Verification& verification);

}  // namespace pellucid::accuracy
