// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>

#include "renderer/error_estimate.h"
#include "renderer/gpu/gl_state_scope.h"
#include "renderer/gpu/loop_limit.h"
#include "renderer/plan/skipping.h"
#include "renderer/plan/slabs.h"
#include "renderer/renderer_state.h"

namespace pellucid::renderer {

namespace {

std::string glText(GLenum what) {
    const auto* text = reinterpret_cast<const char*>(glGetString(what));
    return text != nullptr ? text : "";
}

/// By the name Mesa's CPU rasterisers give themselves; OpenGL has no other way to ask.
bool isSoftware(const std::string& device) {
    for (const char* name : {"llvmpipe", "softpipe", "swrast"})
        if (device.find(name) != std::string::npos) return true;
    return false;
}

int glInteger(GLenum what) {
    GLint value = 0;
    glGetIntegerv(what, &value);
    return value;
}

double msSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// True when everything this scene's mode uses is set: finding defaults reads voxels, which an interactive
/// frame must not pay for.
bool isComplete(const Scene& scene) {
    if (scene.volumes.empty() || !scene.lights || !scene.unitLengthMm) return false;
    const auto& item = scene.volumes.front();
    return (item.transferFunction || !usesTransferFunction(scene.mode)) &&
           (item.window || !usesWindow(scene.mode)) && (item.isovalue || scene.mode != Mode::Isosurface);
}

/// Why a tolerance stated with an integrator that is steered by it is not met; empty when the estimate does
/// not show that.
std::string whyUnmetAsStated(const Quality& quality, const ErrorEstimate& estimate, Integrator integrator) {
    if (!quality.toleranceGreyLevels || errorIn(quality.toleranceNorm, estimate) <= toleranceOf(quality))
        return {};
    if (integrator == Integrator::Importance)
        return whyUnmet(quality, estimate,
                        "importance bounds how far the value leaves a line between samples, not the picture");
    if (integrator == Integrator::Adaptive)
        return whyUnmet(quality, estimate,
                        "adaptive steps are steered by what is seen at samples, and become no shorter than a "
                        "64th of the step stated");
    return {};
}

}  // namespace

Renderer::State::State(GpuContext own)
    : context(std::move(own)), raycast(isSoftware(glText(GL_RENDERER))), maxLoopTurns(measuredLoopLimit()) {}

Renderer::State::~State() {
    context.makeCurrent();
}

DeviceLimits Renderer::State::limits() const {
    return {glInteger(GL_MAX_3D_TEXTURE_SIZE), DeviceLimits{}.maxTextureBytes, maxLoopTurns};
}

Result<const GlProgram*> Renderer::State::program(const Plan& plan) {
    auto found = programs.find(assembleShader(plan.features, plan.stages));
    if (!found) return tl::unexpected(found.error());
    if (found->origin == ProgramCache::Found::Origin::Compiled) ++store.counts.programsCompiled;
    if (found->origin == ProgramCache::Found::Origin::Disk) ++store.counts.programsFromDisk;
    return found->program;
}

FrameTables Renderer::State::tablesFor(const Scene& scene, const Plan& plan, const VolumeFacts& facts,
                                       const RenderOptions& options) {
    FrameTables tables;
    if (!usesTransferFunction(scene.mode) || plan.features.surfaces > 0) return tables;
    const auto& function = *scene.volumes.front().transferFunction;
    const auto space = plan.features.space;
    if (usesPreintegration(plan.features.integrator)) {
        auto& table = store.preintegration(function, space, layoutPreintegration(scene, plan, facts),
                                           !options.allowPreview);
        preview = !completePreintegration(table, !options.allowPreview);
        tables.preintegration = &table;
        return tables;
    }
    if (usesRunningIntegrals(plan.features.integrator))
        tables.integrals = &store.integrals(function, space, plan.table, integralTableSize(facts.type));
    tables.transfer = &store.table(function, space, plan.table);
    return tables;
}

/// Where the scene can show; null when the plan does not ask. Leaves out of the plan what turns out not to
/// pay.
Result<ResourceStore::Leaps*> Renderer::State::leapsFor(const Scene& scene, Plan& plan,
                                                        const VolumePtr& volume, const VolumeTexture& texture,
                                                        const Progress& progress) {
    if (plan.features.skipping == Skipping::None) return nullptr;
    const auto& item = scene.volumes.front();
    const VolumeFacts facts = factsOf(*volume, item.component);
    auto leaps =
        store.leaps(volume, item.component, item.filter, texture, shownValues(scene, plan, facts), progress);
    if (!leaps) return leaps;
    refineSkipping(plan, (*leaps)->occupancy.facts());
    // Without leaps there are more turns for samples.
    if (auto fits = fitLoops(plan, limits()); !fits) return tl::unexpected(fits.error());
    return leaps;
}

Result<const FieldTexture*> Renderer::State::fieldFor(Plan& plan, const VolumePtr& volume, int component,
                                                      const RenderOptions& options) {
    if (plan.features.gradients != GradientSource::Texture) return nullptr;
    auto field = store.field(volume, component);
    if (!field) {
        if (auto fits = dropGradientTexture(plan, limits(), field.error().text()); !fits)
            return tl::unexpected(fits.error());
        return nullptr;
    }
    Plan without = plan;
    const bool canWait =
        options.allowPreview &&
        dropGradientTexture(without, limits(), "it is being made, a part with every picture");
    const double budgetMs = canWait ? options.gradientMs : std::numeric_limits<double>::infinity();
    if (auto made = makeField(**field, *volume, component, budgetMs, options.progress); !made)
        return tl::unexpected(made.error());
    if ((*field)->isComplete()) return *field;
    plan = std::move(without);
    return nullptr;
}

Result<ImageF> Renderer::State::drawOnce(const Scene& scene, Plan& plan, const VolumePtr& volume,
                                         const RenderOptions& options, FrameCost& cost) {
    const auto start = std::chrono::steady_clock::now();
    preview = false;
    const auto& item = scene.volumes.front();
    auto texture = store.volume(volume, item.component, options.progress);
    if (!texture) return tl::unexpected(texture.error());
    const GlTexture* importance = nullptr;
    if (plan.features.integrator == Integrator::Importance) {
        auto made = store.importance(volume, item.component, options.progress);
        if (!made) return tl::unexpected(made.error());
        importance = *made;
    }
    auto leaps = leapsFor(scene, plan, volume, **texture, options.progress);
    if (!leaps) return tl::unexpected(leaps.error());
    auto field = fieldFor(plan, volume, item.component, options);
    if (!field) return tl::unexpected(field.error());
    auto program_ = program(plan);
    if (!program_) return tl::unexpected(program_.error());
    FrameTables tables = tablesFor(scene, plan, factsOf(*volume, item.component), options);
    tables.field = *field;
    if (*leaps != nullptr) tables.occupancy = &(*leaps)->occupancy;
    const Uniforms uniforms = raycastUniforms(scene, plan, volume->grid(), **texture, tables, maxLoopTurns);
    auto target = store.target(targetSize(scene.picture.size));
    if (!target) return tl::unexpected(target.error());
    RaycastInputs inputs;
    inputs.program = *program_;
    inputs.uniforms = &uniforms;
    inputs.volumeTexture = (*texture)->texture.id();
    inputs.transferTable = tables.transfer != nullptr ? tables.transfer->texture.id() : 0;
    if (tables.preintegration != nullptr) inputs.segmentTable = tables.preintegration->texture.id();
    if (tables.integrals != nullptr) inputs.segmentTable = tables.integrals->texture.id();
    inputs.blueNoise = plan.features.jitter ? store.blueNoise().id() : 0;
    inputs.filterWeights = item.filter == Filter::TricubicBSplineLut ? store.filterWeights().id() : 0;
    inputs.leapField = plan.features.skipping == Skipping::Leaps ? store.leapField(**leaps).id() : 0;
    inputs.field = *field != nullptr ? (*field)->texture.id() : 0;
    inputs.importance = importance != nullptr ? importance->id() : 0;
    if (plan.features.surfaces > 0)
        inputs.surfacesBlock =
            store.surfaces(surfaceBlock(item.isosurfaces, plan.features.space, **texture)).id();
    inputs.lightsBlock = plan.features.lit ? store.lights(lightBlock(scene, volume->grid())).id() : 0;
    inputs.interpolates = item.filter != Filter::Nearest;
    inputs.target = *target;
    if (plan.slabs > 1)
        inputs.slabs = Slabs{plan.slabs, samplesPerSlab(plan) * plan.stepMm, backgroundOf(scene, plan),
                             plan.features.space == CompositingSpace::Linear, scene.picture.transparent};
    if (scene.quality.interpolationGreyLevels)
        inputs.interpolation = *scene.quality.interpolationGreyLevels / 255.0;
    inputs.norm = scene.quality.toleranceNorm;
    cost.prepareMs += msSince(start);

    // Remembered per sample of the longest ray, since steps and volumes differ from picture to picture.
    const double samples = std::max(plan.samplesPerRay, 1.0);
    const auto known = msPerSample.find(*program_);
    double msPerPixel =
        samples * (known != msPerSample.end() ? known->second : guessedMsPerSample(plan.features));
    auto image = raycast.draw(inputs, scene.picture.size, options, msPerPixel, cost);
    if (!image) return image;
    msPerSample[*program_] = msPerPixel / samples;
    ++store.counts.frames;
    return image;
}

Result<Plan> Renderer::State::planFor(const Scene& scene, const std::vector<VolumePtr>& volumes) const {
    std::vector<VolumeFacts> facts;
    for (std::size_t i = 0; i < volumes.size(); ++i)
        facts.push_back(factsOf(*volumes[i], i < scene.volumes.size() ? scene.volumes[i].component : 0));
    return makePlan(scene, facts, limits());
}

Result<Plan> Renderer::State::planWithEstimate(const Scene& scene,
                                               const std::vector<VolumePtr>& volumes) const {
    auto plan = planFor(scene, volumes);
    if (!plan || scene.mode == Mode::Slice || planFor(comparison(scene, *plan), volumes)) return plan;
    if (auto finer = planFor(comparisonWithItself(scene, *plan), volumes); !finer) return finer;
    return plan;
}

Result<Frame> Renderer::State::drawStated(const Scene& scene, const std::vector<VolumePtr>& volumes,
                                          const RenderOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    auto plan = planFor(scene, volumes);
    if (!plan) return tl::unexpected(plan.error());
    Frame frame;
    auto image = drawOnce(scene, *plan, volumes.front(), options, frame.cost);
    if (!image) return tl::unexpected(image.error());
    frame.image = std::move(*image);
    frame.preview = preview;
    frame.cost.wallMs = msSince(start);
    if (options.estimateError) {
        const auto draw = [&](const Scene& probe) -> Result<ImageF> {
            auto probePlan = planFor(probe, volumes);
            if (!probePlan) return tl::unexpected(probePlan.error());
            FrameCost unwatched;
            return drawOnce(probe, *probePlan, volumes.front(), options, unwatched);
        };
        auto estimate = estimateError(scene, *plan, options.estimateReduction > 1 ? nullptr : &frame.image,
                                      options.estimateReduction, draw);
        if (!estimate) return tl::unexpected(estimate.error());
        frame.error = std::move(*estimate);
        frame.unmet = whyUnmetAsStated(scene.quality, *frame.error, plan->features.integrator);
    }
    frame.plan = std::move(*plan);
    return frame;
}

Renderer::Renderer(std::unique_ptr<State> state) : m_state(std::move(state)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Result<Renderer> Renderer::headless() {
    auto context = GpuContext::headless();
    if (!context) return tl::unexpected(context.error());
    return Renderer(std::make_unique<State>(std::move(*context)));
}

Result<Renderer> Renderer::inCurrentContext() {
    auto context = GpuContext::current();
    if (!context) return tl::unexpected(context.error());
    return Renderer(std::make_unique<State>(std::move(*context)));
}

Result<Frame> Renderer::render(const Scene& scene, const std::vector<VolumePtr>& volumes,
                               const RenderOptions& options) {
    m_state->context.makeCurrent();
    std::optional<GlStateScope> restore;
    if (!m_state->context.isOwn()) restore.emplace();
    m_state->store.dropGone();

    const Scene full = isComplete(scene) ? scene : completed(scene, volumes);
    if (full.quality.automatic && full.mode != Mode::Slice)
        return m_state->drawAutomatic(full, volumes, options);
    return m_state->drawStated(full, volumes, options);
}

const WorkCounts& Renderer::workCounts() const {
    return m_state->store.counts;
}

DeviceLimits Renderer::limits() const {
    m_state->context.makeCurrent();
    return m_state->limits();
}

void Renderer::limitLoopTurns(double turns) {
    m_state->maxLoopTurns = std::min(m_state->maxLoopTurns, turns);
}

Renderer::DeviceInfo Renderer::deviceInfo() const {
    m_state->context.makeCurrent();
    DeviceInfo info;
    info.vendor = glText(GL_VENDOR);
    info.renderer = glText(GL_RENDERER);
    info.version = glText(GL_VERSION);
    info.software = isSoftware(info.renderer);
    info.max3dTextureSize = glInteger(GL_MAX_3D_TEXTURE_SIZE);
    info.maxUniformBlockBytes = glInteger(GL_MAX_UNIFORM_BLOCK_SIZE);
    info.maxTextureSize = glInteger(GL_MAX_TEXTURE_SIZE);
    info.maxLoopTurns = m_state->maxLoopTurns;
    return info;
}

}  // namespace pellucid::renderer
