// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "renderer/automatic_quality.h"
#include "renderer/gpu/gpu_context.h"
#include "renderer/gpu/program_cache.h"
#include "renderer/passes/raycast_pass.h"
#include "renderer/renderer.h"

namespace pellucid::renderer {

/// What a renderer keeps from picture to picture; renderer.cpp draws what is stated, automatic_drawing.cpp
/// finds what to state.
struct Renderer::State {
    GpuContext context;  // first: everything else needs it to be destroyed
    ProgramCache programs;
    ResourceStore store;
    RaycastPass raycast;
    std::map<const GlProgram*, double> msPerSample;  // of the most expensive tile last drawn

    double maxLoopTurns;
    bool preview = false;  // the last picture used a quickly made table

    /// The last automatic choice and what it was made for, whatever the view: errors hardly change with it.
    struct Choice {
        Scene look;
        std::weak_ptr<const Volume> volume;
        Quality quality;
    };
    std::optional<Choice> choice;

    explicit State(GpuContext own);
    ~State();

    Result<const GlProgram*> program(const Plan& plan);
    FrameTables tablesFor(const Scene& scene, const Plan& plan, const VolumeFacts& facts,
                          const RenderOptions& options);
    Result<ResourceStore::Leaps*> leapsFor(const Scene& scene, Plan& plan, const VolumePtr& volume,
                                           const VolumeTexture& texture, const Progress& progress);
    /// Values and gradients, when the plan has them and they are there; else leaves them out of the plan.
    Result<const FieldTexture*> fieldFor(Plan& plan, const VolumePtr& volume, int component,
                                         const RenderOptions& options);
    /// `plan` learns what the volume's blocks say.
    Result<ImageF> drawOnce(const Scene& scene, Plan& plan, const VolumePtr& volume,
                            const RenderOptions& options, FrameCost& cost);
    /// Draws what is stated; the scene is complete and its quality not automatic.
    Result<Frame> drawStated(const Scene& scene, const std::vector<VolumePtr>& volumes,
                             const RenderOptions& options);
    /// Chooses the quality, draws, and chooses finer ones as long as the estimate is above the tolerance.
    Result<Frame> drawAutomatic(const Scene& scene, const std::vector<VolumePtr>& volumes,
                                const RenderOptions& options);
    /// Draws with more room used, as long as the error stays below the tolerance; `best` and `choice` are the
    /// cheapest after it.
    Result<void> relax(const Scene& scene, const std::vector<VolumePtr>& volumes,
                       const RenderOptions& options, Frame& best);
    /// Sees to it that `choice` is one for this scene and volume; true when it is new. Errors: those of
    /// drawStated.
    Result<bool> choose(const Scene& scene, const std::vector<VolumePtr>& volumes,
                        const RenderOptions& options);
    /// The settings to draw with after these attempts. Errors: those of the plan, when the device allows no
    /// shorter step.
    Result<Quality> finer(const Scene& scene, const std::vector<VolumePtr>& volumes,
                          const std::vector<Attempt>& attempts) const;
    Result<Plan> planFor(const Scene& scene, const std::vector<VolumePtr>& volumes) const;
    /// The same, unless its error could not be estimated since the device refuses the shorter steps for that.
    Result<Plan> planWithEstimate(const Scene& scene, const std::vector<VolumePtr>& volumes) const;
    DeviceLimits limits() const;
};

}  // namespace pellucid::renderer
