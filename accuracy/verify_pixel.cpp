// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Pixel refinement: a pixel, sampled in its middle, against the mean over its area, as the picture of half
// the pixel size has it. For pixels of size h the difference is h^2 / 32 times the Laplacian of the picture
// where it is smooth.
#include <fmt/format.h>

#include <array>

#include "accuracy/verify_scenes.h"
#include "scene/names.h"

namespace pellucid::accuracy {
namespace {

constexpr double kHeightMm = 8.0;
constexpr std::array kPixels{16, 24, 32, 48, 64};

ImageF halved(const ImageF& fine) {
    ImageF coarse{fine.size / 2, std::vector<glm::vec4>(fine.pixels.size() / 4)};
    for (int y = 0; y < coarse.size.y; ++y)
        for (int x = 0; x < coarse.size.x; ++x)
            coarse.at(x, y) = 0.25f * (fine.at(2 * x, 2 * y) + fine.at(2 * x + 1, 2 * y) +
                                       fine.at(2 * x, 2 * y + 1) + fine.at(2 * x + 1, 2 * y + 1));
    return coarse;
}

/// Large voxels where the picture has kinks at all borders a ray crosses: only few in a pixel show as single
/// ones.
int voxelsFor(Mode mode, Filter filter) {
    if (filter != Filter::Nearest) return 24;
    const bool integrated =
        mode == Mode::Composite || mode == Mode::XRay || mode == Mode::Average || mode == Mode::Emission;
    return integrated ? 4 : mode == Mode::Slice ? 12 : 24;
}

/// So fine that what a step does differently from ray to ray is less than what is measured: a jump of the
/// value makes the sum over steps jump, too. Fields without kinks need less.
double stepVoxelsFor(Mode mode, Filter filter) {
    if (filter == Filter::Nearest) return voxelsFor(mode, filter) == 4 ? 1.0 / 1024.0 : 1.0 / 16.0;
    return filter == Filter::Trilinear ? 1.0 / 16.0 : 1.0 / 4.0;
}

OrderRow expectation(Mode mode, Filter filter) {
    OrderRow row{"pixel", name(mode), "", name(filter)};
    row.expected = 2.0;
    row.tolerance = 0.15;
    const bool integrated =
        mode == Mode::Composite || mode == Mode::XRay || mode == Mode::Average || mode == Mode::Emission;
    if (filter == Filter::Nearest && !integrated) {
        row.expected = 1.0;
        row.tolerance = mode == Mode::Slice ? 0.5 : 0.3;  // a slice meets few voxels
        row.reason =
            "the picture jumps where the voxel met changes: an error of the jump in a share of pixels like h";
    } else if (filter == Filter::Nearest) {
        row.claim = Claim::AtLeast;
        row.expected = 1.5;
        row.reason =
            "the length of a ray in a voxel has kinks: order 2 once a pixel holds one at most, 1.5 where "
            "several add "
            "up at random";
    } else if (filter == Filter::Trilinear && !integrated) {
        row.claim = Claim::AtLeast;
        row.expected = 1.5;
        row.tolerance = 0.3;
        row.reason =
            "the picture has kinks at voxel centres: errors like h in a share of pixels like h, and fewer "
            "while a pixel is not small beside a voxel";
    }
    return row;
}

}  // namespace

Result<std::vector<OrderRow>> verifyPixelOrders(renderer::Renderer& renderer, const Progress& progress,
                                                const OrderFound& found) {
    std::vector<OrderRow> rows;
    double done = 0.0;
    const auto modes = enumNames<Mode>();
    for (const auto& mode : modes) {
        if (!goOn(progress, done++ / static_cast<double>(modes.size()), fmt::format("pixel: {}", mode.name)))
            return fail(ErrorCode::Cancelled, "the verification was cancelled");
        for (const auto& filter : enumNames<Filter>()) {
            if (fieldOf(filter.value) != filter.value) continue;  // errors of a field, not of ways to draw it
            OrderRow row = expectation(mode.value, filter.value);
            const VolumePtr volume =
                bumpVolume(voxelsFor(mode.value, filter.value), mode.value == Mode::MinIp);
            for (const int n : kPixels) {
                Scene scene = verifyScene(mode.value, filter.value, n, kHeightMm);
                // Rolled, so that no border of voxels is parallel to the pixels.
                if (filter.value == Filter::Nearest) scene.camera.pose->up = {0.37, 0.0, 1.0};
                scene.quality.stepVoxels = stepVoxelsFor(mode.value, filter.value);
                const auto coarse = pictureOf(renderer, scene, volume);
                if (!coarse) return tl::unexpected<Error>(coarse.error());
                scene.picture.size *= 2;
                const auto fine = pictureOf(renderer, scene, volume);
                if (!fine) return tl::unexpected<Error>(fine.error());
                row.sizes.push_back(kHeightMm / n);
                row.errors.push_back(meanError(*coarse, halved(*fine)));
            }
            if (found) found(row);
            rows.push_back(std::move(row));
        }
    }
    return rows;
}

}  // namespace pellucid::accuracy
