// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "accuracy/reference.h"
#include "accuracy/report_data.h"

/// What the pictures of a report are compared with.
namespace pellucid::accuracy {

[[nodiscard]] ReferenceKind referenceOf(const ReportSetting& setting, const Scene& scene);

/// "trilinear, VTK's box": for people.
[[nodiscard]] std::string referenceName(const ReferenceKind& kind);
/// "reference-trilinear-peers": for files and keys.
[[nodiscard]] std::string referenceStem(const ReferenceKind& kind);

/// The reference picture of a kind, from steps of one voxel on. `options`: bound, halvings and progress.
/// Precondition: the scene is completed(). Errors: as referencePicture.
[[nodiscard]] Result<Reference> drawReference(const Scene& scene, const VolumePtr& volume,
                                              const ReferenceKind& kind, glm::ivec2 size,
                                              ReferenceOptions options);

}  // namespace pellucid::accuracy
