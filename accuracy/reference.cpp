// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "accuracy/ray_integrator.h"

namespace pellucid::accuracy {
namespace {

Result<Scene> checkedScene(const Scene& scene, const std::vector<VolumePtr>& volumes) {
    if (volumes.size() != 1 || scene.volumes.size() > 1)
        return fail(
            ErrorCode::Unsupported,
            fmt::format("the reference draws one volume; there are {} volumes and {} items in the scene",
                        volumes.size(), scene.volumes.size()));
    const Volume& volume = *volumes.front();
    if (auto valid = validate(volume.grid()); !valid) return fail(valid.error(), "volume 0");
    if (!scene.volumes.empty()) {
        const int component = scene.volumes.front().component;
        if (component < 0 || component >= volume.components())
            return fail(ErrorCode::InvalidArgument,
                        fmt::format("/volumes/0/component: found {}, the volume has {}", component,
                                    volume.components()));
    }
    if (auto valid = validate(scene); !valid) return tl::unexpected<Error>(valid.error());
    Scene complete = completed(scene, volumes);
    if (auto valid = validate(complete); !valid) return tl::unexpected<Error>(valid.error());
    return complete;
}

using Pixels = std::vector<glm::dvec4>;

/// All cores take rows from one counter; the caller's thread works too and is the one that reports progress.
Result<Pixels> drawn(const RayIntegrator& integrator, glm::ivec2 size, double stepMm,
                     const Progress& progress) {
    Pixels pixels(static_cast<std::size_t>(size.x) * size.y);
    std::atomic<int> nextRow{0};
    std::atomic<bool> cancelled{false};
    const auto drawRows = [&](const Progress& report) {
        for (int y = nextRow++; y < size.y && !cancelled; y = nextRow++) {
            for (int x = 0; x < size.x; ++x)
                pixels[static_cast<std::size_t>(y) * size.x + x] =
                    integrator.pixel(2.0 * (x + 0.5) / size.x - 1.0, 1.0 - 2.0 * (y + 0.5) / size.y, stepMm);
            if (!goOn(report, static_cast<double>(y + 1) / size.y, "reference picture")) cancelled = true;
        }
    };
    std::vector<std::thread> threads;
    for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i)
        threads.emplace_back(drawRows, Progress{});
    drawRows(progress);
    for (std::thread& thread : threads) thread.join();
    if (cancelled) return fail(ErrorCode::Cancelled, "the reference picture was cancelled");
    return pixels;
}

double largestDifference(const Pixels& a, const Pixels& b) {
    double result = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (int channel = 0; channel < 4; ++channel)
            // Written so that a NaN does not compare its way out.
            if (const double error = std::abs(a[i][channel] - b[i][channel]); !(error <= result))
                result = error;
    return result;
}

double rmsDifference(const Pixels& a, const Pixels& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (int channel = 0; channel < 3; ++channel) sum += std::pow(a[i][channel] - b[i][channel], 2.0);
    return std::sqrt(sum / (3.0 * static_cast<double>(a.size())));
}

ImageF imageOf(const Pixels& pixels, glm::ivec2 size) {
    ImageF image{size, {}};
    image.pixels.reserve(pixels.size());
    for (const glm::dvec4& pixel : pixels) image.pixels.emplace_back(pixel);
    return image;
}

}  // namespace

Result<ImageF> referenceAtStep(const Scene& scene, const std::vector<VolumePtr>& volumes, double stepMm,
                               const Progress& progress) {
    if (!(stepMm > 0.0))
        return fail(ErrorCode::InvalidArgument, fmt::format("the step must be above 0 mm, found {}", stepMm));
    const auto complete = checkedScene(scene, volumes);
    if (!complete) return tl::unexpected<Error>(complete.error());
    const RayIntegrator integrator(*complete, *volumes.front());
    const auto pixels = drawn(integrator, complete->picture.size, stepMm, progress);
    if (!pixels) return tl::unexpected<Error>(pixels.error());
    return imageOf(*pixels, complete->picture.size);
}

Result<Reference> referencePicture(const Scene& scene, const std::vector<VolumePtr>& volumes,
                                   const ReferenceOptions& options) {
    const auto complete = checkedScene(scene, volumes);
    if (!complete) return tl::unexpected<Error>(complete.error());
    const RayIntegrator integrator(*complete, *volumes.front(), options.insetVoxels, options.clip);
    const glm::ivec2 size = complete->picture.size;

    double step = stepMm(complete->quality, volumes.front()->grid());
    double reached = std::numeric_limits<double>::infinity();
    double reachedRmse = reached;
    auto pixels = drawn(integrator, size, step, options.progress);
    if (!pixels) return tl::unexpected<Error>(pixels.error());
    for (int halving = 0; halving < options.maxHalvings && !(reached < options.bound); ++halving) {
        step /= 2.0;
        auto finer = drawn(integrator, size, step, options.progress);
        if (!finer) return tl::unexpected<Error>(finer.error());
        reached = largestDifference(*pixels, *finer);
        reachedRmse = rmsDifference(*pixels, *finer);
        pixels = std::move(finer);
    }
    return Reference{imageOf(*pixels, size), reached, reachedRmse, step};
}

}  // namespace pellucid::accuracy
