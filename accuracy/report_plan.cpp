// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/report_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/plan/features.h"

namespace pellucid::accuracy {
namespace {

template <class E>
std::vector<E> allOf() {
    std::vector<E> values;
    for (const auto& entry : enumNames<E>()) values.push_back(entry.value);
    return values;
}

/// The scene's own first. Filters that make another one's field by other means are there for comparison.
std::vector<Filter> filtersOf(const Scene& scene, bool withComparisons) {
    const Filter own = scene.volumes.front().filter;
    std::vector<Filter> filters{own};
    for (const Filter filter : allOf<Filter>())
        if (filter != own && (withComparisons || fieldOf(filter) == filter)) filters.push_back(filter);
    return filters;
}

/// As large as `limit` allows, in the shape it has.
glm::ivec2 atMost(glm::ivec2 size, int limit) {
    const int longest = std::max(size.x, size.y);
    if (longest <= limit) return size;
    const double scale = static_cast<double>(limit) / longest;
    return glm::max(glm::ivec2(glm::round(glm::dvec2(size) * scale)), glm::ivec2(1));
}

/// Collects settings, each kind of drawing once.
class SettingList {
public:
    explicit SettingList(const Scene& scene) : m_scene(scene) {}

    void add(const ReportSetting& setting) {
        if (setting.integrator == Integrator::Importance && !boundsBends(setting.filter)) return;
        const Scene drawn = sceneWith(m_scene, setting, m_scene.picture.size);
        const Known known{renderer::featuresOf(drawn), m_scene.mode == Mode::Slice ? 0.0 : setting.stepVoxels,
                          setting.tolerance, setting.automatic};
        const bool ownFeatures = known.features.integrator == setting.integrator &&
                                 known.features.jitter == setting.jitter &&
                                 known.features.accumulation == setting.accumulation;
        if (!ownFeatures || std::find(m_known.begin(), m_known.end(), known) != m_known.end()) return;
        m_known.push_back(known);
        settings.push_back(setting);
    }

    std::vector<ReportSetting> settings;

private:
    struct Known {
        renderer::Features features;
        double step = 0.0;
        std::optional<double> tolerance;
        bool automatic = false;
        bool operator==(const Known&) const = default;
    };
    const Scene& m_scene;
    std::vector<Known> m_known;
};

void addSteps(SettingList& list, ReportSetting setting, const ReportScope& scope) {
    const bool importance = setting.integrator == Integrator::Importance;
    if (setting.integrator == Integrator::Adaptive || importance || setting.automatic) {
        setting.stepVoxels = importance ? 0.25 : 1.0;
        for (const double tolerance : scope.tolerances) {
            setting.tolerance = tolerance;
            list.add(setting);
        }
        return;
    }
    for (const double step : scope.steps) {
        setting.stepVoxels = step;
        list.add(setting);
    }
}

void addPeers(std::vector<ReportSetting>& settings, const ReportScope& scope) {
    for (const auto& [renderer, jitter] :
         {std::pair("vtk-gpu", false), std::pair("vtk-gpu", true), std::pair("vtk-fixed-point", false)}) {
        if (jitter && !scope.jitter) continue;
        for (const double step : scope.steps) {
            ReportSetting setting;
            setting.renderer = renderer;
            setting.jitter = jitter;
            setting.stepVoxels = step;
            settings.push_back(setting);
        }
    }
}

}  // namespace

ReportScope fullScope(const Scene& scene) {
    ReportScope scope;
    scope.integrators = allOf<Integrator>();
    scope.filters = filtersOf(scene, true);
    scope.accumulations = allOf<Accumulation>();
    scope.steps = {4.0, 2.0, 1.0, 0.5, 0.25, 0.125};
    scope.tolerances = {8.0, 4.0, 2.0, 1.0, 0.5, 0.25};
    scope.pictureSize = scene.picture.size;
    return scope;
}

ReportScope quickScope(const Scene& scene) {
    ReportScope scope = fullScope(scene);
    scope.filters = filtersOf(scene, false);
    scope.steps = {4.0, 2.0, 1.0, 0.5};
    scope.tolerances = {4.0, 1.0};
    scope.pictureSize = atMost(scene.picture.size, 128);
    scope.warmFrames = 2;
    scope.referenceBound = 1e-4;
    scope.referenceHalvings = 1;
    scope.crossed = false;
    scope.warmSeconds = 1.0;
    scope.budgetSeconds = 45.0;
    scope.reductions = {
        fmt::format("The picture has {} x {} pixels instead of the scene's {} x {}.", scope.pictureSize.x,
                    scope.pictureSize.y, scene.picture.size.x, scene.picture.size.y),
        "Steps are 4 to 1/2 voxel instead of 4 to 1/8.",
        "Times are medians of at most 2 warm frames instead of 5.",
        "Filters that make the field of another one by other means are left out.",
        "Other filters and accumulation formats are measured with the exponential integrator only.",
        "References are halved once, with a bound of 1e-4 asked for; the bound reached is stated.",
        "Nothing is begun that is not expected to end within 45 seconds; running the command again measures "
        "the rest."};
    return scope;
}

std::vector<ReportSetting> reportSettings(const Scene& scene, const ReportScope& scope) {
    SettingList list(scene);
    const auto add = [&](Filter filter, Accumulation accumulation, Integrator integrator, bool jitter) {
        ReportSetting setting;
        setting.filter = filter;
        setting.accumulation = accumulation;
        setting.integrator = integrator;
        setting.jitter = jitter;
        addSteps(list, setting, scope);
    };
    constexpr Accumulation kFloat = Accumulation::Float32;
    const Filter own = scope.filters.front();
    for (const Integrator integrator : scope.integrators) add(own, kFloat, integrator, false);
    if (scene.mode != Mode::Slice) {  // which has no step
        ReportSetting automatic;
        automatic.filter = own;
        automatic.automatic = true;
        addSteps(list, automatic, scope);
    }
    // Early, so that a quick report whose time is up has them.
    if (scope.peers) addPeers(list.settings, scope);
    for (const Accumulation accumulation : scope.accumulations)
        add(own, accumulation, Integrator::Exponential, false);
    if (scope.jitter) add(own, kFloat, Integrator::Exponential, true);
    for (const Filter filter : scope.filters) add(filter, kFloat, Integrator::Exponential, false);
    if (scope.crossed) {
        for (const Filter filter : scope.filters)
            for (const Accumulation accumulation : scope.accumulations)
                // Another filter's field by other means: the same errors again.
                if (fieldOf(filter) == filter || filter == own)
                    for (const Integrator integrator : scope.integrators)
                        add(filter, accumulation, integrator, false);
    }
    return list.settings;
}

Scene sceneWith(const Scene& scene, const ReportSetting& setting, glm::ivec2 size) {
    Scene result = scene;
    for (VolumeItem& item : result.volumes) item.filter = setting.filter;
    result.quality.integrator = setting.integrator;
    result.quality.accumulation = setting.accumulation;
    result.quality.jitter = setting.jitter;
    result.quality.interpolationGreyLevels.reset();
    result.quality.stepVoxels = setting.stepVoxels;
    result.quality.stepMm.reset();
    result.quality.toleranceGreyLevels = setting.tolerance;
    result.quality.toleranceNorm = ErrorNorm::Rmse;
    result.quality.automatic = setting.automatic;
    result.quality.earlyTermination = kReportTermination;
    // A height in mm stays; only the number of pixels changes.
    result.picture.size = size;
    result.picture.transparent = false;
    return result;
}

std::string methodName(const ReportSetting& setting) {
    if (isPeer(setting)) return setting.renderer;
    return setting.automatic ? "automatic" : name(setting.integrator);
}

std::string seriesName(const ReportSetting& setting) {
    std::string text = methodName(setting);
    if (!isPeer(setting)) text += fmt::format(", {}, {}", name(setting.filter), name(setting.accumulation));
    if (setting.jitter) text += ", jitter";
    return text;
}

std::string settingName(const ReportSetting& setting) {
    if (setting.tolerance) return fmt::format("{}, tolerance {:g}", seriesName(setting), *setting.tolerance);
    return fmt::format("{}, step {:g}", seriesName(setting), setting.stepVoxels);
}

bool isShown(const ReportSetting& setting, const ReportScope& scope) {
    if (isPeer(setting)) return setting.stepVoxels == 1.0;
    if (setting.filter != scope.filters.front()) return false;
    if (setting.tolerance) return *setting.tolerance == 1.0;
    return setting.stepVoxels == 1.0 &&
           (setting.accumulation == Accumulation::Float32 || setting.integrator == Integrator::Exponential);
}

}  // namespace pellucid::accuracy
