// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>

#include "accuracy/report_data.h"
#include "renderer/renderer.h"

namespace pellucid::accuracy {

/// How pictures get into files and back; files are another room's.
struct PictureFiles {
    std::function<Result<void>(const std::filesystem::path&, const Image8&)> writePng;
    std::function<Result<void>(const std::filesystem::path&, const ImageF&)> writeFloat;
    std::function<Result<ImageF>(const std::filesystem::path&)> readFloat;
};

struct ReportJob {
    Scene scene;  ///< Completed.
    VolumePtr volume;
    std::string name;
    ReportScope scope;
    std::filesystem::path folder;  ///< Exists. Gets measurements.jsonl, reference-FILTER.pfm, pictures/.
    PictureFiles files;
    Progress progress;
};

/// Factor by which the difference pictures are brightened.
inline constexpr double kDifferenceGain = 32.0;

/// Name of a setting's picture in folder/pictures, and of its difference to the reference.
[[nodiscard]] std::string pictureFile(const ReportSetting& setting);
[[nodiscard]] std::string differenceFile(const ReportSetting& setting);
[[nodiscard]] std::string referenceFile(const ReferenceKind& kind);

/// Measures what is not yet in the folder. Errors: Cancelled (what is finished is kept and the next run goes
/// on), those of the renderer and of files.
[[nodiscard]] Result<ReportData> measureReport(const ReportJob& job, renderer::Renderer& renderer);

}  // namespace pellucid::accuracy
