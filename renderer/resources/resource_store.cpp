// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/resources/resource_store.h"

#include "renderer/plan/importance.h"
#include "renderer/resources/blue_noise.h"
#include "renderer/resources/filter_weights.h"

#include <fmt/format.h>

#include <algorithm>

namespace pellucid::renderer {

namespace {

// Four views with a preview and an error probe each use no more functions and sizes than this at a time.
constexpr std::size_t kKeptTables = 16;
constexpr std::size_t kKeptTargets = 8;
// A picture, its preview and its error probe; each may take a byte for 64 voxels twice.
constexpr std::size_t kKeptLeaps = 4;

/// Moves a found entry to the front; returns false when there is none.
template <class T, class Matches>
bool toFront(std::list<T>& entries, const Matches& matches) {
    const auto found = std::find_if(entries.begin(), entries.end(), matches);
    if (found == entries.end()) return false;
    entries.splice(entries.begin(), entries, found);
    return true;
}

/// What was made of this component of the volume and matches, moved to the front; null when there is none.
template <class Entries, class Matches>
auto* ofVolume(Entries& entries, const VolumePtr& volume, int component, const Matches& matches) {
    const bool known = toFront(entries, [&](const auto& entry) {
        return entry.component == component && entry.volume.lock() == volume && matches(entry.made);
    });
    return known ? &entries.front().made : nullptr;
}

template <class Entries>
auto* ofVolume(Entries& entries, const VolumePtr& volume, int component) {
    return ofVolume(entries, volume, component, [](const auto&) { return true; });
}

bool isFrom(const TableLayout& a, const TransferTexture& table) {
    return a.lo == table.layout.lo && a.hi == table.layout.hi && a.size == table.layout.size;
}
bool isFrom(const PreintegrationLayout& layout, const PreintegrationTexture& table) {
    return layout == table.layout;
}

struct IntegralLayout {
    double lo, hi;
    int size;
};
bool isFrom(const IntegralLayout& layout, const IntegralTexture& table) {
    return layout.lo == table.lo && layout.hi == table.hi && layout.size == table.size;
}

/// The entry for these values, at the front of the list; made by `make` (from the function in its compositing
/// space) when there is none.
template <class Entries, class Layout, class Make>
auto& findOrMake(Entries& entries, const TransferFunction1D& function, CompositingSpace space,
                 const Layout& layout, int& counter, const Make& make) {
    const bool known = toFront(entries, [&](const auto& entry) {
        return entry.space == space && isFrom(layout, entry.table) &&
               entry.function.points == function.points;
    });
    if (!known) {
        entries.push_front({function, space, make(inCompositingSpace(function, space))});
        ++counter;
        if (entries.size() > kKeptTables) entries.pop_back();
    }
    return entries.front().table;
}

}  // namespace

void ResourceStore::dropGone() {
    const auto drop = [](auto&... lists) {
        (lists.remove_if([](const auto& entry) { return entry.volume.expired(); }), ...);
    };
    drop(m_volumes, m_fields, m_importances, m_ranges, m_leaps);
}

Result<const VolumeTexture*> ResourceStore::volume(const VolumePtr& volume, int component,
                                                   const Progress& progress) {
    if (const auto* known = ofVolume(m_volumes, volume, component)) return known;
    auto uploaded = uploadVolume(*volume, component, progress);
    if (!uploaded) return tl::unexpected(uploaded.error());
    ++counts.volumeUploads;
    m_volumes.push_front({volume, component, std::move(*uploaded)});
    return &m_volumes.front().made;
}

const TransferTexture& ResourceStore::table(const TransferFunction1D& function, CompositingSpace space,
                                            const TableLayout& layout) {
    return findOrMake(
        m_tables, function, space, layout, counts.transferTables,
        [&](const TransferFunction1D& converted) { return uploadTransferTable(converted, layout); });
}

PreintegrationTexture& ResourceStore::preintegration(const TransferFunction1D& function,
                                                     CompositingSpace space,
                                                     const PreintegrationLayout& layout, bool wait) {
    return findOrMake(
        m_preintegrations, function, space, layout, counts.preintegrationTables,
        [&](const TransferFunction1D& converted) { return uploadPreintegration(converted, layout, wait); });
}

const IntegralTexture& ResourceStore::integrals(const TransferFunction1D& function, CompositingSpace space,
                                                const TableLayout& domain, int size) {
    const IntegralLayout layout{domain.lo, domain.hi, size};
    return findOrMake(m_integrals, function, space, layout, counts.transferTables,
                      [&](const TransferFunction1D& converted) {
                          return uploadIntegrals(converted, domain.lo, domain.hi, size);
                      });
}

Result<const BlockRanges*> ResourceStore::ranges(const VolumePtr& volume, int component, int voxels,
                                                 const Progress& progress) {
    const auto* known = ofVolume(m_ranges, volume, component,
                                 [&](const PaddedRanges& padded) { return padded.voxels == voxels; });
    if (known != nullptr) return &known->ranges;
    auto found = blockRanges(*volume, component, voxels, progress);
    if (found.lo.empty()) return fail(ErrorCode::Cancelled, "the search for empty space was cancelled");
    ++counts.blockRanges;
    m_ranges.push_front({volume, component, {voxels, std::move(found)}});
    return &m_ranges.front().made.ranges;
}

Result<ResourceStore::Leaps*> ResourceStore::leaps(const VolumePtr& volume, int component, Filter filter,
                                                   const VolumeTexture& texture,
                                                   const std::vector<ValueRange>& shown,
                                                   const Progress& progress) {
    const FilterReach reach = reachOf(filter);
    auto* known = ofVolume(m_leaps, volume, component, [&](const ShownLeaps& entry) {
        return entry.reach == reach && entry.shown == shown;
    });
    if (known != nullptr) return &known->leaps;
    auto blocks = ranges(volume, component, reach.voxels, progress);
    if (!blocks) return tl::unexpected(blocks.error());
    std::vector<ValueRange> texels;
    for (const ValueRange& range : shown) {
        const double a = texture.texelFromPhysical(range.lo);
        const double b = texture.texelFromPhysical(range.hi);
        texels.push_back({std::min(a, b), std::max(a, b)});
    }
    ++counts.occupancies;
    Leaps leaps{occupancyOf(**blocks, ShownQuanta(texels), reach.overshoot), GlTexture()};
    m_leaps.push_front({volume, component, {reach, shown, std::move(leaps)}});
    if (m_leaps.size() > kKeptLeaps) m_leaps.pop_back();
    return &m_leaps.front().made.leaps;
}

const GlTexture& ResourceStore::leapField(Leaps& leaps) {
    if (!leaps.field) leaps.field = uploadLeapField(leaps.occupancy);
    return leaps.field;
}

Result<const GlTexture*> ResourceStore::importance(const VolumePtr& volume, int component,
                                                   const Progress& progress) {
    if (const auto* known = ofVolume(m_importances, volume, component)) return known;
    auto grid = importanceOf(*volume, component, progress);
    if (!grid) return tl::unexpected(grid.error());
    ++counts.importanceVolumes;
    GlTexture texture = createTexture(GL_TEXTURE_3D);
    glTextureStorage3D(texture.id(), 1, GL_RG32F, grid->size.x, grid->size.y, grid->size.z);
    glTextureSubImage3D(texture.id(), 0, 0, 0, 0, grid->size.x, grid->size.y, grid->size.z, GL_RG, GL_FLOAT,
                        grid->bends.data());
    m_importances.push_front({volume, component, std::move(texture)});
    return &m_importances.front().made;
}

Result<FieldTexture*> ResourceStore::field(const VolumePtr& volume, int component) {
    if (auto* known = ofVolume(m_fields, volume, component)) return known;
    auto field = allocateField(layoutField(factsOf(*volume, component)));
    if (!field) return tl::unexpected(field.error());
    ++counts.fieldTextures;
    m_fields.push_front({volume, component, std::move(*field)});
    return &m_fields.front().made;
}

const GlTexture& ResourceStore::blueNoise() {
    if (!m_blueNoise) m_blueNoise = createBlueNoise();
    return m_blueNoise;
}

const GlTexture& ResourceStore::filterWeights() {
    if (!m_filterWeights) m_filterWeights = createBSplineWeights();
    return m_filterWeights;
}

const GlBuffer& ResourceStore::UniformBlock::holding(const std::vector<glm::vec4>& block) {
    if (m_block != block || !m_buffer) {
        const auto bytes = static_cast<GLsizeiptr>(block.size() * sizeof(glm::vec4));
        m_buffer = createBuffer();
        glNamedBufferStorage(m_buffer.id(), bytes, block.data(), 0);
        m_block = block;
    }
    return m_buffer;
}

Result<const ResourceStore::Target*> ResourceStore::target(glm::ivec2 size) {
    if (toFront(m_targets, [&](const Target& target) { return target.size == size; }))
        return &m_targets.front();
    Target target{createTexture(GL_TEXTURE_2D), createFramebuffer(), size};
    glTextureStorage2D(target.color.id(), 1, GL_RGBA32F, size.x, size.y);
    glNamedFramebufferTexture(target.framebuffer.id(), GL_COLOR_ATTACHMENT0, target.color.id(), 0);
    if (glCheckNamedFramebufferStatus(target.framebuffer.id(), GL_DRAW_FRAMEBUFFER) !=
        GL_FRAMEBUFFER_COMPLETE)
        return fail(
            ErrorCode::Gpu,
            fmt::format("the driver cannot draw into a float picture of {} x {} pixels", size.x, size.y));
    m_targets.push_front(std::move(target));
    if (m_targets.size() > kKeptTargets) m_targets.pop_back();
    return &m_targets.front();
}

}  // namespace pellucid::renderer
