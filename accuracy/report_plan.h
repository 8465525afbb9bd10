// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "accuracy/report_data.h"

namespace pellucid::accuracy {

/// What ends rays early in every setting: small enough that the error seen is the integrator's.
inline constexpr double kReportTermination = 1e-5;

/// Everything: all integrators, filters and formats at steps of 4 to 1/8 voxel, in the scene's own picture
/// size.
[[nodiscard]] ReportScope fullScope(const Scene& scene);
/// A picture of at most 128 x 128 pixels, four steps, the other filters and formats with one integrator only.
[[nodiscard]] ReportScope quickScope(const Scene& scene);

/// The settings in the order in which they are measured: the scene's own filter first, peers last. What the
/// scene cannot tell apart (integrators in a projection without them, steps of a slice) occurs once.
/// Precondition: the scene is completed().
[[nodiscard]] std::vector<ReportSetting> reportSettings(const Scene& scene, const ReportScope& scope);

/// The scene drawn by a setting. `size`: of the picture.
[[nodiscard]] Scene sceneWith(const Scene& scene, const ReportSetting& setting, glm::ivec2 size);

/// "simpson", "automatic", "vtk-gpu".
[[nodiscard]] std::string methodName(const ReportSetting& setting);
/// "simpson, trilinear, float32, step 0.5": unique, and the key under which a measurement is kept.
[[nodiscard]] std::string settingName(const ReportSetting& setting);
/// What the settings along one curve share: the same without step or tolerance.
[[nodiscard]] std::string seriesName(const ReportSetting& setting);

/// Settings whose picture is shown beside the reference: the scene's filter at a middle step, each
/// integrator, format and peer.
[[nodiscard]] bool isShown(const ReportSetting& setting, const ReportScope& scope);

}  // namespace pellucid::accuracy
