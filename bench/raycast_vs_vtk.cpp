// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Ray casting against vtkGPUVolumeRayCastMapper: the same 512 x 512 picture at the same sample distance,
// frame by frame in turns, from the call to the pixels in memory. Prints a table: medians of warm frames, and
// the RMSE of each picture against the reference.
//
//   xvfb-run -a raycast_vs_vtk [--frames N] [--cpu] [--no-reference] [--only TEXT] [--pictures FOLDER]
//   [--all-samples] [VOLUME]
//
// --cpu counts processor time of all cores instead of the wall clock: for a software driver on a machine that
// is busy with other things. --all-samples switches empty-space skipping off. --only keeps the rows that hold
// a text. --pictures writes what is compared.
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <optional>
#include <string_view>

#include "accuracy/metrics.h"
#include "accuracy/reference.h"
#include "bench/bench_cases.h"
#include "bench/render_thread.h"
#include "bench/vtk_peer.h"
#include "io/image_file.h"
#include "renderer/renderer.h"

namespace pellucid::bench {
namespace {

struct Options {
    int frames = 7;
    bool cpuTime = false;
    bool withReference = true;
    bool allSamples = false;
    std::string only;
    std::string path;
    std::string pictures;
};

/// Milliseconds since some start: of the wall clock, or of all cores' work for this process.
double milliseconds(bool cpuTime) {
    if (cpuTime) return 1000.0 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2.0;
}

/// The renderer on its own thread.
class Ours {
public:
    Ours() {
        m_thread.run([this] { m_renderer.emplace(renderer::Renderer::headless()); });
    }
    ~Ours() {
        m_thread.run([this] { m_renderer.reset(); });
    }

    [[nodiscard]] std::optional<Error> problem() const {
        return *m_renderer ? std::nullopt : std::optional<Error>(m_renderer->error());
    }
    [[nodiscard]] std::string driver() {
        std::string text;
        m_thread.run([&] {
            const auto info = (*m_renderer)->deviceInfo();
            text = info.renderer + ", OpenGL " + info.version;
        });
        return text;
    }

    /// Milliseconds from the call to the pixels; the picture replaces `image`.
    Result<double> draw(const Scene& scene, const VolumePtr& volume, bool cpuTime, ImageF& image) {
        Result<double> ms = 0.0;
        m_thread.run([&] {
            const double start = milliseconds(cpuTime);
            renderer::RenderOptions options;
            options.tileTargetMs = 1000.0;  // VTK draws a picture at once too
            auto frame = (*m_renderer)->render(scene, {volume}, options);
            if (frame) {
                ms = milliseconds(cpuTime) - start;
                image = std::move(frame->image);
            } else {
                ms = tl::unexpected<Error>(frame.error());
            }
        });
        return ms;
    }

private:
    RenderThread m_thread;
    std::optional<Result<renderer::Renderer>> m_renderer;
};

struct Row {
    double vtkMs = 0.0;
    double stoppingMs = 0.0;  ///< Ours, rays ending at 1 - 1/255 as VTK's do.
    double wholeMs = 0.0;     ///< Ours, rays never ending early.
    ImageF vtkImage, stoppingImage, wholeImage;
};

Result<Row> measure(const BenchCase& c, Ours& ours, const Options& options) {
    Scene whole = c.scene;
    whole.quality.earlyTermination = 0.0;
    whole.quality.skipEmpty = !options.allSamples;
    Scene stopping = c.scene;
    stopping.quality.earlyTermination = 1.0 / 255.0;
    stopping.quality.skipEmpty = !options.allSamples;
    Row row;
    VtkPeer vtk(c.scene, *c.volume);
    std::vector<double> vtkMs, stoppingMs, wholeMs;
    for (int frame = 0; frame <= options.frames; ++frame) {
        const double start = milliseconds(options.cpuTime);
        vtk.draw();
        const double vtkTime = milliseconds(options.cpuTime) - start;
        const auto stoppingTime = ours.draw(stopping, c.volume, options.cpuTime, row.stoppingImage);
        if (!stoppingTime) return tl::unexpected<Error>(stoppingTime.error());
        const auto wholeTime = ours.draw(whole, c.volume, options.cpuTime, row.wholeImage);
        if (!wholeTime) return tl::unexpected<Error>(wholeTime.error());
        if (frame == 0) continue;  // Uploads and compilation.
        vtkMs.push_back(vtkTime);
        stoppingMs.push_back(*stoppingTime);
        wholeMs.push_back(*wholeTime);
    }
    row.vtkMs = median(vtkMs);
    row.stoppingMs = median(stoppingMs);
    row.wholeMs = median(wholeMs);
    row.vtkImage = vtk.image();
    return row;
}

std::string rmse(const ImageF& image, const std::optional<ImageF>& reference) {
    if (!reference) return "-";
    const auto difference = accuracy::difference(image, *reference);
    return difference ? fmt::format("{:.5f}", difference->rmse) : difference.error().text();
}

/// FOLDER/row-NAME.png; a failure is said and does not stop the table.
void write(const std::string& folder, int row, const char* name, const ImageF& image) {
    if (folder.empty()) return;
    const auto written =
        io::writePng(fmt::format("{}/{}-{}.png", folder, row, name), quantise(image, false, false));
    if (!written) std::fprintf(stderr, "%s\n", written.error().text().c_str());
}

int run(const Options& options) {
    const auto cases = benchCases(options.path);
    if (!cases) {
        std::fprintf(stderr, "%s\n", cases.error().text().c_str());
        return 2;
    }
    Ours ours;
    if (const auto problem = ours.problem()) {
        std::fprintf(stderr, "%s\n", problem->text().c_str());
        return 2;
    }
    std::printf("%s; medians of %d warm frames, ms of %s\n\n", ours.driver().c_str(), options.frames,
                options.cpuTime ? "processor time" : "wall clock");
    std::printf(
        "| Data | Look | Projection | VTK | ours, rays end at 1 - 1/255 | ratio | ours, whole rays | ratio | "
        "RMSE VTK | RMSE ours | RMSE ours, whole |\n");
    std::printf("|---|---|---|--:|--:|--:|--:|--:|--:|--:|--:|\n");
    int rows = 0;
    for (const BenchCase& c : *cases) {
        if (fmt::format("{} {} {}", c.data, c.look, c.projection).find(options.only) == std::string::npos)
            continue;
        const auto row = measure(c, ours, options);
        if (!row) {
            std::fprintf(stderr, "%s\n", row.error().text().c_str());
            return 2;
        }
        std::optional<ImageF> reference;
        if (options.withReference) {
            // One voxel is enough: between cell borders the integrator is of order 6 and adapts to the shade.
            auto drawn = accuracy::referenceAtStep(c.scene, {c.volume}, smallestSpacingMm(c.volume->grid()));
            if (drawn) reference = std::move(*drawn);
        }
        std::printf("| %s | %s | %s | %.0f | %.0f | %.2f | %.0f | %.2f | %s | %s | %s |\n", c.data.c_str(),
                    c.look.c_str(), c.projection.c_str(), row->vtkMs, row->stoppingMs,
                    row->vtkMs / row->stoppingMs, row->wholeMs, row->vtkMs / row->wholeMs,
                    rmse(row->vtkImage, reference).c_str(), rmse(row->stoppingImage, reference).c_str(),
                    rmse(row->wholeImage, reference).c_str());
        std::fflush(stdout);
        ++rows;
        write(options.pictures, rows, "vtk", row->vtkImage);
        write(options.pictures, rows, "ours", row->wholeImage);
        if (reference) write(options.pictures, rows, "reference", *reference);
    }
    return 0;
}

}  // namespace
}  // namespace pellucid::bench

int main(int argc, char** argv) {
    pellucid::bench::Options options;
    for (int i = 1; i < argc; ++i) {
        const std::string_view argument = argv[i];
        const bool more = i + 1 < argc;
        if (argument == "--no-reference") {
            options.withReference = false;
        } else if (argument == "--all-samples") {
            options.allSamples = true;
        } else if (argument == "--cpu") {
            options.cpuTime = true;
        } else if (argument == "--only" && more) {
            options.only = argv[++i];
        } else if (argument == "--pictures" && more) {
            options.pictures = argv[++i];
        } else if (argument == "--frames" && more) {
            const std::string_view count = argv[++i];
            std::from_chars(count.data(), count.data() + count.size(), options.frames);
            options.frames = std::max(options.frames, 1);
        } else {
            options.path = argument;
        }
    }
    return pellucid::bench::run(options);
}
