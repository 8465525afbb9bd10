// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/picture.h"

#include <fmt/format.h>

#include <chrono>

#include "app/cli/cli.h"
#include "app/cli/console.h"
#include "io/image_file.h"
#include "renderer/automatic_quality.h"
#include "renderer/renderer.h"
#include "scene/names.h"

namespace pellucid::app {

namespace fs = std::filesystem;

namespace {

double millisecondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// A picture may take minutes: say before that its place does not exist.
Result<void> checkOutput(const fs::path& file) {
    if (!isPictureName(file)) {
        return fail(ErrorCode::InvalidArgument,
                    fmt::format("{}: the name of a picture ends in .png, .npy or .pfm", file.string()));
    }
    std::error_code ignored;
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, ignored)) {
        return fail(ErrorCode::WriteFailed,
                    fmt::format("{}: there is no folder {}", file.string(), folder.string()));
    }
    if (fs::is_directory(file, ignored)) {
        return fail(ErrorCode::WriteFailed, fmt::format("{} is a folder, not a picture", file.string()));
    }
    return {};
}

Result<void> write(const fs::path& file, const ImageF& image, const Scene& scene) {
    if (file.extension() == ".npy") return io::writeNpy(file, image);
    if (file.extension() == ".pfm") return io::writePfm(file, image);
    return io::writePng(file, quantise(image, scene.picture.transparent, scene.quality.dither));
}

std::string errorText(const std::optional<renderer::ErrorEstimate>& error) {
    if (!error) return "error not estimated";
    const auto greyLevels = [](double shown) { return 255.0 * shown; };
    return fmt::format("error {:.3g} grey levels RMSE, {:.3g} at most (estimated at {} pixels)",
                       greyLevels(error->rmse), greyLevels(error->maxError), error->probedPixels);
}

/// What was chosen for a scene that states an error and leaves the rest open, and whether an error stated is
/// met, as far as that is known; empty for others.
std::string choiceText(const renderer::Frame& frame, const Quality& asked) {
    std::string text;
    if (frame.chosen)
        text = fmt::format("chosen: {}, steps of {:.3g} voxels; ", name(frame.chosen->integrator),
                           frame.chosen->stepVoxels);
    else if (frame.unmet.empty())
        return {};
    return text + fmt::format("the tolerance of {} is {}\n", renderer::toleranceText(asked),
                              frame.unmet.empty() ? "met" : "NOT met: " + frame.unmet);
}

}  // namespace

bool isPictureName(const fs::path& file) {
    const fs::path extension = file.extension();
    return extension == ".png" || extension == ".npy" || extension == ".pfm";
}

int makePicture(const PictureJob& job) {
    for (const fs::path& file : job.outputs) {
        if (const Result<void> possible = checkOutput(file); !possible) return report(possible.error());
    }
    const auto start = std::chrono::steady_clock::now();
    const Result<io::LoadedScene> loaded = openInput(job.input, job.look);
    if (!loaded) return report(loaded.error());
    const double loadMs = millisecondsSince(start);

    Result<renderer::Renderer> renderer = renderer::Renderer::headless();
    if (!renderer) return report(renderer.error());
    renderer::RenderOptions options;
    options.progress = consoleProgress();
    options.estimateError = job.estimateError;
    options.tileTargetMs = 200.0;  // no window waits; Ctrl+C is still heard at once
    const auto drawStart = std::chrono::steady_clock::now();
    const Result<renderer::Frame> frame = renderer->render(loaded->scene, loaded->volumes, options);
    if (!frame) return report(frame.error());
    const double drawMs = millisecondsSince(drawStart);

    clearProgress();
    fmt::print("{}", choiceText(*frame, loaded->scene.quality));
    for (const fs::path& file : job.outputs) {
        if (const Result<void> written = write(file, frame->image, loaded->scene); !written) {
            return report(written.error());
        }
        fmt::print("{}: {}x{}, {:.1f} ms (GPU {:.1f} ms), loaded in {:.1f} ms, {}\n", file.string(),
                   frame->image.size.x, frame->image.size.y, drawMs, frame->cost.gpuMs, loadMs,
                   errorText(frame->error));
    }
    return kExitOk;
}

}  // namespace pellucid::app
