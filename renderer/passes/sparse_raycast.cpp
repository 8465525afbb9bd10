// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Pictures of fewer rays than pixels (sparse_rays.h says which).
#include <algorithm>

#include "renderer/passes/raycast_pass.h"

namespace pellucid::renderer {

namespace {

/// Sites are moved up in the target so that tiles of 16 pixels begin at multiples of 4 there: software
/// rasterisers shade blocks of 4 x 4 as a whole.
int shiftOf(const Lattice& lattice) {
    constexpr int kBlock = 4;
    return (lattice.origin / lattice.stride % kBlock + kBlock) % kBlock;
}

/// The lower rows of the target, each as wide as the target.
void readRows(const ResourceStore::Target& target, int width, int rows, std::vector<glm::vec4>& pixels) {
    pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(rows));
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glGetTextureSubImage(target.color.id(), 0, 0, 0, 0, width, rows, 1, GL_RGBA, GL_FLOAT,
                         static_cast<GLsizei>(pixels.size() * sizeof(glm::vec4)), pixels.data());
}

/// The picture of the finest lattice, whose rows go up.
ImageF imageOf(const Lattice& fine) {
    ImageF image{fine.size, std::vector<glm::vec4>(fine.sites.size())};
    for (int row = 0; row < fine.size.y; ++row)
        std::copy_n(fine.sites.begin() + static_cast<std::ptrdiff_t>(fine.index(0, row)), fine.size.x,
                    &image.at(0, fine.size.y - 1 - row));
    return image;
}

}  // namespace

Result<void> RaycastPass::traceSites(const RaycastInputs& inputs, std::span<const Tile> runs,
                                     Lattice& lattice, const RenderOptions& options, TileBudget& budget,
                                     FrameCost& cost) {
    if (runs.empty()) return {};
    const int shift = shiftOf(lattice);
    // The centre of the target's pixel `shift` is the lattice's first site, half a pixel inside its pixel.
    setPlace(inputs, {static_cast<double>(lattice.stride),
                      glm::vec2(static_cast<float>(lattice.origin + 0.5 - lattice.stride * (shift + 0.5)))});
    std::vector<Tile> batch;
    double pixels = 0.0;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        batch.push_back({runs[i].origin + shift, runs[i].size});
        pixels += static_cast<double>(runs[i].size.x) * runs[i].size.y;
        if (pixels < budget.wantedPixels() && i + 1 < runs.size()) continue;
        if (!goOn(options.progress, static_cast<double>(i) / static_cast<double>(runs.size()), "drawing"))
            return fail(ErrorCode::Cancelled, "the drawing was cancelled");
        budget.took(pixels, drawTiles(inputs, batch, cost));
        batch.clear();
        pixels = 0.0;
    }
    std::vector<glm::vec4> rows;
    const int width = std::min(lattice.size.x + shift, inputs.target->size.x);
    readRows(*inputs.target, width, std::min(lattice.size.y + shift, inputs.target->size.y), rows);
    if (inputs.slabs) finish(*inputs.slabs, rows);
    lattice.sites.resize(static_cast<std::size_t>(lattice.size.x) * static_cast<std::size_t>(lattice.size.y));
    for (const Tile& run : runs)
        for (int j = run.origin.y; j < run.origin.y + run.size.y; ++j)
            std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(j + shift) * width + run.origin.x + shift,
                        run.size.x,
                        lattice.sites.begin() + static_cast<std::ptrdiff_t>(lattice.index(run.origin.x, j)));
    return {};
}

Result<ImageF> RaycastPass::drawSparsely(const RaycastInputs& inputs, glm::ivec2 size,
                                         const RenderOptions& options, TileBudget& budget, FrameCost& cost) {
    auto [coarse, middle, fine] = latticesOf(size);
    std::vector<Tile> all;
    for (TileCutter cutter(coarse.size); !cutter.done();) all.push_back(cutter.next(budget.wantedPixels()));
    if (auto traced = traceSites(inputs, all, coarse, options, budget, cost); !traced)
        return tl::unexpected(traced.error());
    SparseRays rays(size, *inputs.interpolation, inputs.norm);
    const TileChoice* choice = &rays.afterCoarse(coarse);
    interpolate(coarse, middle);
    const Lattice interpolated = middle;
    if (auto traced = traceSites(inputs, runsOf(choice->count, choice->traceMiddle, middle), middle, options,
                                 budget, cost);
        !traced)
        return tl::unexpected(traced.error());
    choice = &rays.afterMiddle(middle, interpolated);
    interpolate(middle, fine);
    if (auto traced =
            traceSites(inputs, runsOf(choice->count, choice->traceFine, fine), fine, options, budget, cost);
        !traced)
        return tl::unexpected(traced.error());
    return imageOf(fine);
}

}  // namespace pellucid::renderer
