// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <list>
#include <memory>

#include "renderer/plan/shown_values.h"
#include "renderer/renderer.h"
#include "renderer/resources/field_texture.h"
#include "renderer/resources/leap_texture.h"
#include "renderer/resources/preintegration_texture.h"
#include "renderer/resources/transfer_texture.h"
#include "renderer/resources/volume_texture.h"

namespace pellucid::renderer {

/// GPU objects by the values they depend on: an edit rebuilds what depends on it and nothing else. Volumes
/// and all that was made of them go when nobody else holds them, tables when newer ones have pushed them out.
class ResourceStore {
public:
    /// Drops what was made of volumes that are gone; before each picture, since it may be many times what the
    /// picture needs.
    void dropGone();
    [[nodiscard]] Result<const VolumeTexture*> volume(const VolumePtr& volume, int component,
                                                      const Progress& progress);
    [[nodiscard]] const TransferTexture& table(const TransferFunction1D& function, CompositingSpace space,
                                               const TableLayout& layout);
    /// `wait` false allows a preview (completePreintegration tells).
    [[nodiscard]] PreintegrationTexture& preintegration(const TransferFunction1D& function,
                                                        CompositingSpace space,
                                                        const PreintegrationLayout& layout, bool wait);
    [[nodiscard]] const IntegralTexture& integrals(const TransferFunction1D& function, CompositingSpace space,
                                                   const TableLayout& domain, int size);
    /// Where a volume's values in the closed intervals `shown` (physical, those of shownValues) occur.
    /// Errors: Cancelled.
    struct Leaps {
        Occupancy occupancy;
        GlTexture field;  ///< Empty until asked for by leapField.
    };
    [[nodiscard]] Result<Leaps*> leaps(const VolumePtr& volume, int component, Filter filter,
                                       const VolumeTexture& texture, const std::vector<ValueRange>& shown,
                                       const Progress& progress);
    [[nodiscard]] const GlTexture& leapField(Leaps& leaps);
    /// How much a volume bends, from its voxels alone; kept as long as the volume. Errors: Cancelled.
    [[nodiscard]] Result<const GlTexture*> importance(const VolumePtr& volume, int component,
                                                      const Progress& progress);
    /// Values and gradients of a volume, perhaps still to be made; kept as long as the volume. Errors: Gpu.
    [[nodiscard]] Result<FieldTexture*> field(const VolumePtr& volume, int component);
    [[nodiscard]] const GlTexture& blueNoise();
    [[nodiscard]] const GlTexture& filterWeights();
    /// A std140 block with the scene's lights; kept while the lights are the same.
    [[nodiscard]] const GlBuffer& lights(const std::vector<glm::vec4>& block) {
        return m_lights.holding(block);
    }
    /// The same for its isosurfaces.
    [[nodiscard]] const GlBuffer& surfaces(const std::vector<glm::vec4>& block) {
        return m_surfaces.holding(block);
    }
    /// The float target, kept while its size is the same.
    struct Target {
        GlTexture color;
        GlFramebuffer framebuffer;
        glm::ivec2 size{0, 0};
    };
    /// Errors: Gpu when the driver cannot draw into it.
    [[nodiscard]] Result<const Target*> target(glm::ivec2 size);

    WorkCounts counts;

private:
    /// Something made of one component of a volume, which goes with it.
    template <class Made>
    struct OfVolume {
        std::weak_ptr<const Volume> volume;
        int component = 0;
        Made made;
    };
    /// A buffer, made anew when what it is to hold changes.
    class UniformBlock {
    public:
        [[nodiscard]] const GlBuffer& holding(const std::vector<glm::vec4>& block);

    private:
        std::vector<glm::vec4> m_block;
        GlBuffer m_buffer;
    };
    /// A table and what it was made from.
    template <class Table>
    struct FunctionTable {
        TransferFunction1D function;
        CompositingSpace space = CompositingSpace::Display;
        Table table;
    };
    /// Value ranges of a volume's blocks, as filters that read so many voxels need them.
    struct PaddedRanges {
        int voxels = 0;
        BlockRanges ranges;
    };
    struct ShownLeaps {
        FilterReach reach;
        std::vector<ValueRange> shown;
        Leaps leaps;
    };
    [[nodiscard]] Result<const BlockRanges*> ranges(const VolumePtr& volume, int component, int voxels,
                                                    const Progress& progress);
    std::list<OfVolume<VolumeTexture>> m_volumes;  // this and the next four most recently used first
    std::list<OfVolume<FieldTexture>> m_fields;
    std::list<OfVolume<GlTexture>> m_importances;
    std::list<OfVolume<PaddedRanges>> m_ranges;
    std::list<OfVolume<ShownLeaps>> m_leaps;
    std::list<FunctionTable<PreintegrationTexture>> m_preintegrations;
    std::list<FunctionTable<IntegralTexture>> m_integrals;
    GlTexture m_blueNoise;
    GlTexture m_filterWeights;
    std::list<FunctionTable<TransferTexture>> m_tables;  // most recently used first
    std::list<Target> m_targets;                         // most recently used first
    UniformBlock m_lights;
    UniformBlock m_surfaces;
};

}  // namespace pellucid::renderer
