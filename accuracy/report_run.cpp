// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/report_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "accuracy/machine_info.h"
#include "accuracy/metrics.h"
#include "accuracy/peers/peer.h"
#include "accuracy/report_json.h"
#include "accuracy/report_plan.h"
#include "accuracy/report_reference.h"
#include "accuracy/report_stalls.h"
#include "accuracy/report_store.h"
#include "scene/scene_json.h"

namespace pellucid::accuracy {
namespace {

using Clock = std::chrono::steady_clock;

double msSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2.0;
}

std::string fileStem(const ReportSetting& setting) {
    std::string stem = settingName(setting);
    std::replace(stem.begin(), stem.end(), ' ', '-');
    std::erase(stem, ',');
    return stem;
}

/// The absolute difference of each channel, brightened, opaque.
ImageF brightenedDifference(const ImageF& a, const ImageF& b) {
    ImageF result = a;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        result.pixels[i] = glm::vec4(
            static_cast<float>(kDifferenceGain) * glm::abs(glm::vec3(a.pixels[i] - b.pixels[i])), 1.0F);
    return result;
}

struct Drawn {
    ImageF image;
    std::vector<double> wall, gpu;
};

/// One report being measured.
class Run {
public:
    Run(const ReportJob& job, renderer::Renderer& renderer, ReportStore store)
        : m_job(job), m_renderer(renderer), m_store(std::move(store)), m_start(Clock::now()) {}

    Result<void> measure(ReportData& data) {
        std::vector<ReportSetting> settings = reportSettings(m_job.scene, m_job.scope);
        withoutUselessPeers(settings, data);
        data.planned = static_cast<int>(settings.size());
        if (auto stalls = addStalls(data); !stalls) return stalls;
        for (std::size_t i = 0; i < settings.size(); ++i) {
            const ReportSetting& setting = settings[i];
            m_fraction = static_cast<double>(i) / static_cast<double>(settings.size());
            m_what = settingName(setting);
            const nlohmann::json* known = m_store.find(keyOf(setting));
            if (known == nullptr) {
                auto why = whyLeftOut(setting, data);
                if (!why) return tl::unexpected(why.error());
                if (*why) {
                    data.leftOut.push_back({setting, **why});
                    continue;
                }
                if (auto done = measureOne(setting); !done) return done;
                known = m_store.find(keyOf(setting));
            }
            if (auto measurement = measurementFromJson(*known)) data.measurements.push_back(*measurement);
        }
        addReferences(data);
        return {};
    }

private:
    std::string keyOf(const ReportSetting& setting) const {
        return fmt::format("{}; {}x{}, {} frames", settingName(setting), m_job.scope.pictureSize.x,
                           m_job.scope.pictureSize.y, m_job.scope.warmFrames);
    }
    std::string referenceKey(const ReferenceKind& kind) const {
        return fmt::format("{}; {}x{}, bound {:g}, {} halvings", referenceStem(kind),
                           m_job.scope.pictureSize.x, m_job.scope.pictureSize.y, m_job.scope.referenceBound,
                           m_job.scope.referenceHalvings);
    }
    Progress progress() const {
        return [this](double, std::string_view what) {
            return goOn(m_job.progress, m_fraction, fmt::format("{} ({})", m_what, what));
        };
    }

    /// Seconds of one frame, from the curve's coarser settings: in proportion to the samples, and with half
    /// the tolerance as at order 1. 0: nothing is known yet.
    static double expectedFrameSeconds(const ReportSetting& setting, const ReportData& data) {
        for (auto m = data.measurements.rbegin(); m != data.measurements.rend(); ++m)
            if (seriesName(m->setting) == seriesName(setting))
                return 1e-3 * m->wallMs *
                       (setting.tolerance ? *m->setting.tolerance / *setting.tolerance
                                          : m->setting.stepVoxels / setting.stepVoxels);
        return 0.0;
    }

    /// Measured on a picture with 1/64 of the pixels; 0 for one that is there already.
    Result<double> expectedReferenceSeconds(const ReferenceKind& kind) {
        if (m_store.find(referenceKey(kind)) != nullptr) return 0.0;
        const glm::ivec2 size = m_job.scope.pictureSize;
        const glm::ivec2 small = glm::max(size / 8, glm::ivec2(1));
        const auto start = Clock::now();
        const auto tried = drawReference(m_job.scene, m_job.volume, kind, small, referenceOptions());
        if (!tried) return tl::unexpected(tried.error());
        return 1e-3 * msSince(start) * size.x * size.y / (static_cast<double>(small.x) * small.y);
    }

    /// Nothing when the setting is to be measured now.
    Result<std::optional<std::string>> whyLeftOut(const ReportSetting& setting, const ReportData& data) {
        const ReportScope& scope = m_job.scope;
        const double frame = expectedFrameSeconds(setting, data);
        if (frame > scope.mostFrameSeconds)
            return std::optional(fmt::format("a frame would take about {:.0f} s", frame));
        const ReferenceKind kind = referenceOf(setting, m_job.scene);
        const std::string key = referenceKey(kind);
        if (!m_referenceSeconds.contains(key)) {
            const auto seconds = expectedReferenceSeconds(kind);
            if (!seconds) return tl::unexpected(seconds.error());
            m_referenceSeconds[key] = *seconds;
        }
        const bool isThere = m_store.find(key) != nullptr;
        const double reference = isThere ? 0.0 : m_referenceSeconds[key];
        if (reference > scope.mostReferenceSeconds)
            return std::optional(fmt::format("its reference would take about {:.0f} min", reference / 60.0));
        if (!scope.budgetSeconds) return std::nullopt;
        // A first frame compiles; what is not known is taken for short.
        constexpr double kCompilation = 0.5;
        const double frames =
            std::max(2.0 * frame, std::min((1 + scope.warmFrames) * frame, scope.warmSeconds));
        const double left = *scope.budgetSeconds - 1e-3 * msSince(m_start);
        if (reference + kCompilation + frames <= left) return std::nullopt;
        return std::optional<std::string>("the time was up; the same command again measures it");
    }

    void withoutUselessPeers(std::vector<ReportSetting>& settings, ReportData& data) const {
        if (!m_job.scope.peers) return;
        const auto why = whyNoPeers(m_job.scene, *m_job.volume);
        if (!why) return;
        data.notes.push_back(*why);
        std::erase_if(settings, isPeer);
    }

    Result<void> addStalls(ReportData& data) {
        const nlohmann::json* known = m_store.find("stalls");
        if (known == nullptr) {
            m_what = "stalls of the accumulation formats";
            const auto stalls = measureStalls(m_renderer, progress());
            if (!stalls) return tl::unexpected(stalls.error());
            if (auto kept = m_store.add("stalls", stallsJson(*stalls)); !kept) return kept;
            known = m_store.find("stalls");
        }
        data.stalls = stallsFromJson(*known);
        return {};
    }

    void addReferences(ReportData& data) const {
        std::vector<ReferenceKind> kinds;
        for (const Filter filter : m_job.scope.filters)
            if (fieldOf(filter) == filter) kinds.push_back({filter});
        if (m_job.scope.peers)
            for (const bool lightAtEye : {false, true})
                kinds.push_back({Filter::Trilinear, true, lightAtEye});
        for (const ReferenceKind& kind : kinds)
            if (const nlohmann::json* known = m_store.find(referenceKey(kind)))
                data.references.push_back({kind, known->value("reachedBound", 0.0),
                                           known->value("reachedRmse", 0.0), known->value("stepMm", 0.0),
                                           known->value("ms", 0.0)});
    }

    /// Kept in memory one at a time, and in a file for the next run.
    Result<const ImageF*> referenceFor(const ReferenceKind& kind) {
        if (m_reference && m_referenceKind == kind) return &*m_reference;
        const std::filesystem::path file = m_job.folder / (referenceStem(kind) + ".pfm");
        m_reference.reset();
        if (m_store.find(referenceKey(kind)) != nullptr) {
            auto read = m_job.files.readFloat(file);
            if (read && read->size == m_job.scope.pictureSize) m_reference = std::move(*read);
        }
        if (!m_reference) {
            if (auto made = makeReference(kind, file); !made) return tl::unexpected(made.error());
        }
        m_referenceKind = kind;
        return &*m_reference;
    }

    ReferenceOptions referenceOptions() const {
        ReferenceOptions options;
        options.bound = m_job.scope.referenceBound;
        options.maxHalvings = m_job.scope.referenceHalvings;
        options.progress = progress();
        return options;
    }

    Result<void> makeReference(const ReferenceKind& kind, const std::filesystem::path& file) {
        const auto start = Clock::now();
        auto reference =
            drawReference(m_job.scene, m_job.volume, kind, m_job.scope.pictureSize, referenceOptions());
        if (!reference) return tl::unexpected(reference.error());
        const nlohmann::json facts{{"reachedBound", reference->reachedBound},
                                   {"reachedRmse", reference->reachedRmse},
                                   {"stepMm", reference->stepMm},
                                   {"ms", msSince(start)}};
        if (auto written = m_job.files.writeFloat(file, reference->image); !written) return written;
        if (auto written = m_job.files.writePng(m_job.folder / "pictures" / referenceFile(kind),
                                                quantise(reference->image, false, false));
            !written)
            return written;
        m_reference = std::move(reference->image);
        return m_store.add(referenceKey(kind), facts);
    }

    /// Where the renderer chooses the settings, the first frame chooses and verifies them, and the warm ones
    /// are drawn with what was chosen, as in a window.
    Result<Drawn> drawOwn(Scene scene, Measurement& m) {
        Drawn drawn;
        renderer::RenderOptions options;
        options.progress = progress();
        const auto start = Clock::now();
        for (int frame = 0; frame <= m_job.scope.warmFrames; ++frame) {
            if (frame > 1 && msSince(start) > 1000.0 * m_job.scope.warmSeconds) break;
            const auto frameStart = Clock::now();
            auto result = m_renderer.render(scene, {m_job.volume}, options);
            if (!result) return tl::unexpected(result.error());
            const double ms = msSince(frameStart);
            if (frame == 0) {
                m.firstMs = ms;
                m.bytes = result->plan.totalBytes;
                if (result->chosen) scene.quality = *result->chosen;
            } else {
                drawn.wall.push_back(ms);
                drawn.gpu.push_back(result->cost.gpuMs);
            }
            drawn.image = std::move(result->image);
        }
        return drawn;
    }

    Result<Drawn> drawPeer(const Scene& scene, Measurement& m) {
        if (!goOn(m_job.progress, m_fraction, m_what))
            return fail(ErrorCode::Cancelled, "the report was cancelled");
        auto frames = drawByPeer(scene, *m_job.volume, m.setting, m_job.scope.warmFrames);
        if (!frames) return tl::unexpected(frames.error());
        m.firstMs = frames->firstMs;
        return Drawn{std::move(frames->image), std::move(frames->warmMs), {}};
    }

    Result<void> measureOne(const ReportSetting& setting) {
        const auto reference = referenceFor(referenceOf(setting, m_job.scene));
        if (!reference) return tl::unexpected(reference.error());
        const Scene scene = sceneWith(m_job.scene, setting, m_job.scope.pictureSize);
        Measurement m;
        m.setting = setting;
        m.stepMm = stepMm(scene.quality, m_job.volume->grid());
        const auto drawn = isPeer(setting) ? drawPeer(scene, m) : drawOwn(scene, m);
        if (!drawn) return tl::unexpected(drawn.error());
        m.warmFrames = static_cast<int>(drawn->wall.size());
        m.wallMs = median(drawn->wall);
        if (!drawn->gpu.empty()) m.gpuMs = median(drawn->gpu);
        const auto error = difference(drawn->image, **reference);
        if (!error) return tl::unexpected(error.error());
        m.maxError = error->maxError;
        m.rmse = error->rmse;
        m.psnr = error->psnr;
        m.ssim = error->ssim;
        if (isShown(setting, m_job.scope)) {
            if (auto shown = writePictures(setting, drawn->image, **reference); !shown) return shown;
        }
        return m_store.add(keyOf(setting), measurementJson(m));
    }

    Result<void> writePictures(const ReportSetting& setting, const ImageF& image,
                               const ImageF& reference) const {
        const std::filesystem::path pictures = m_job.folder / "pictures";
        auto written = m_job.files.writePng(pictures / pictureFile(setting), quantise(image, false, false));
        if (!written) return written;
        return m_job.files.writePng(pictures / differenceFile(setting),
                                    quantise(brightenedDifference(image, reference), false, false));
    }

    const ReportJob& m_job;
    renderer::Renderer& m_renderer;
    ReportStore m_store;
    Clock::time_point m_start;
    std::optional<ImageF> m_reference;
    ReferenceKind m_referenceKind;
    std::map<std::string, double> m_referenceSeconds;  ///< Expected, by key.
    double m_fraction = 0.0;
    std::string m_what;
};

}  // namespace

std::string pictureFile(const ReportSetting& setting) {
    return fileStem(setting) + ".png";
}

std::string differenceFile(const ReportSetting& setting) {
    return fileStem(setting) + "-difference.png";
}

std::string referenceFile(const ReferenceKind& kind) {
    return referenceStem(kind) + ".png";
}

Result<ReportData> measureReport(const ReportJob& job, renderer::Renderer& renderer) {
    ReportData data;
    data.name = job.name;
    Scene saved = job.scene;
    for (VolumeItem& item : saved.volumes) item.source.clear();  // Where a file lies changes no picture.
    data.sceneText = sceneText(saved);
    data.sceneHash = fmt::format(
        "{:016x}", stableHash(job.volume->bytes(), stableHash(std::as_bytes(std::span(data.sceneText)))));
    data.voxels = job.volume->grid().size;
    data.spacingMm = spacingMm(job.volume->grid());
    data.machine = machineInfo(renderer.deviceInfo());
    data.scope = job.scope;

    std::error_code error;
    std::filesystem::create_directories(job.folder / "pictures", error);
    if (error)
        return fail(ErrorCode::WriteFailed, fmt::format("{} cannot be made: {}",
                                                        (job.folder / "pictures").string(), error.message()));
    const std::string context = fmt::format("{}; {}; {}; {}", data.sceneHash, data.machine.build,
                                            data.machine.driver, data.machine.cpu);
    auto store = ReportStore::open(job.folder / "measurements.jsonl", context);
    if (!store) return tl::unexpected(store.error());
    Run run(job, renderer, std::move(*store));
    if (auto measured = run.measure(data); !measured) return tl::unexpected(measured.error());
    return data;
}

}  // namespace pellucid::accuracy
