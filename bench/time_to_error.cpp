// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Time until a picture is within an error, ours by one rule (the renderer chooses for the error asked) beside
// VTK's two mappers at the sample distances they were tried at. One table row a scene; all in one run.
//
//   xvfb-run -a time_to_error -o FOLDER [--only TEXT] [--size N] [--frames N] [--no-peers] [SCAN ...]
//
// Measured by the report's machinery: what is finished is kept in FOLDER, and the same command goes on.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "accuracy/report_analysis.h"
#include "accuracy/report_plan.h"
#include "accuracy/report_run.h"
#include "bench/bench_cases.h"
#include "io/image_file.h"

namespace pellucid::bench {
namespace {

struct Options {
    std::string folder = "time-to-error";
    std::string only;
    std::vector<std::string> scans;
    int size = 512;
    int frames = 5;
    bool noPeers = false;
};

/// What is tried of each renderer: the error levels of ours, the sample distances of the others.
accuracy::ReportScope scopeOf(const Scene& scene, const Options& options) {
    accuracy::ReportScope scope;
    scope.filters = {scene.volumes.front().filter};
    scope.accumulations = {};
    scope.jitter = false;
    scope.steps = {4.0, 2.0, 1.0, 0.5, 0.25, 0.125};
    for (const double level : accuracy::kErrorLevels) scope.tolerances.push_back(255.0 * level);
    scope.pictureSize = scene.picture.size;
    scope.warmFrames = options.frames;
    scope.referenceBound = 1e-4;
    scope.referenceHalvings = 1;
    scope.crossed = false;
    scope.peers = !options.noPeers;
    return scope;
}

/// Of ours the frame drawn for that level, whatever its error turned out to be, since nobody would draw
/// another; "!" where it missed the level.
struct Ours {
    double ms = 0.0;
    double rmse = 0.0;
};

std::optional<Ours> oursAt(const accuracy::ReportData& data, double level) {
    for (const auto& m : data.measurements)
        if (m.setting.automatic && std::abs(*m.setting.tolerance - 255.0 * level) < 1e-9)
            return Ours{m.wallMs, m.rmse};
    return std::nullopt;
}

std::optional<accuracy::TimeToError> peerAt(const accuracy::ReportAnalysis& analysis,
                                            const accuracy::ReportData& data, const std::string& renderer,
                                            std::size_t level) {
    for (const auto& series : analysis.series)
        if (data.measurements[series.members.front()].setting.renderer == renderer)
            return series.timesToError[level];
    return std::nullopt;
}

std::string timeText(const std::optional<accuracy::TimeToError>& time, double ours) {
    if (!time) return "never";
    return fmt::format("{}{:.0f} ({:.1f}x)", time->atMost ? "<=" : "", time->ms, time->ms / ours);
}

void printRows(const BenchCase& c, const accuracy::ReportData& data, const Scene& scene) {
    const auto analysis = accuracy::analyse(data, scene);
    for (std::size_t i = 0; i < std::size(accuracy::kErrorLevels); ++i) {
        const double level = accuracy::kErrorLevels[i];
        const auto ours = oursAt(data, level);
        if (!ours) continue;
        std::printf("| %s, %s, %s | %g | %.1f | %.5f%s | %s | %s |\n", c.data.c_str(), c.look.c_str(),
                    c.projection.c_str(), level, ours->ms, ours->rmse, ours->rmse > level ? " (missed)" : "",
                    timeText(peerAt(analysis, data, "vtk-gpu", i), ours->ms).c_str(),
                    timeText(peerAt(analysis, data, "vtk-fixed-point", i), ours->ms).c_str());
    }
    std::fflush(stdout);
}

int run(const Options& options) {
    auto cases = errorCases(options.scans, options.size);
    auto renderer = renderer::Renderer::headless();
    const auto failed = [](const Error& error) {
        std::fprintf(stderr, "%s\n", error.text().c_str());
        return 2;
    };
    if (!cases) return failed(cases.error());
    if (!renderer) return failed(renderer.error());
    std::printf("%s, OpenGL %s; %d x %d, medians of %d warm frames, wall clock\n\n",
                renderer->deviceInfo().renderer.c_str(), renderer->deviceInfo().version.c_str(), options.size,
                options.size, options.frames);
    std::printf("| Scene | RMSE asked | ours, ms | its RMSE | VTK GPU, ms | VTK fixed point, ms |\n");
    std::printf("|---|--:|--:|--:|--:|--:|\n");
    for (const BenchCase& c : *cases) {
        const std::string name = fmt::format("{}, {}, {}", c.data, c.look, c.projection);
        if (name.find(options.only) == std::string::npos) continue;
        accuracy::ReportJob job;
        job.scene = c.scene;
        job.volume = c.volume;
        job.name = name;
        job.scope = scopeOf(c.scene, options);
        std::string stem = name;
        for (char& letter : stem)
            if (letter == ' ' || letter == ',' || letter == '^' || letter == '/') letter = '-';
        job.folder = std::filesystem::path(options.folder) / stem;
        std::filesystem::create_directories(job.folder);
        job.files = {io::writePng, io::writePfm, io::readPfm};
        const auto data = accuracy::measureReport(job, *renderer);
        if (!data) return failed(data.error());
        printRows(c, *data, c.scene);
    }
    return 0;
}

}  // namespace
}  // namespace pellucid::bench

int main(int argc, char** argv) {
    pellucid::bench::Options options;
    CLI::App program("Time until a picture is within an error, beside VTK");
    program.add_option("-o,--output", options.folder, "Folder for what is measured");
    program.add_option("--only", options.only, "Keeps the rows whose name holds this text");
    program.add_option("--size", options.size, "Pixels of the picture's sides");
    program.add_option("--frames", options.frames, "Warm frames a median is taken of");
    program.add_flag("--no-peers", options.noPeers, "Ours alone");
    program.add_option("scans", options.scans, "Scans to measure beside the synthetic scenes");
    CLI11_PARSE(program, argc, argv);
    return pellucid::bench::run(options);
}
