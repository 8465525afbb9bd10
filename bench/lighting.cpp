// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// What light costs: each scene unlit, lit with gradients on the fly, and lit with gradients from a texture,
// 512 x 512, whole frames of one step. The two lit pictures are compared first.
//
//   lighting [--step VOXELS] [--frames N] [VOLUME ...]
//
// Times are processor time of all cores, medians of rounds in which the three take turns.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>

#include "accuracy/metrics.h"
#include "accuracy/synthetic.h"
#include "bench/bench_cases.h"
#include "io/load.h"
#include "renderer/renderer.h"

namespace pellucid::bench {
namespace {

struct LitCase {
    std::string name;
    VolumePtr volume;
    std::optional<TransferFunction1D> function;
};

std::vector<LitCase> litCases() {
    return {{"Marschner-Lobb 128^3, thin shells", accuracy::marschnerLobb(128), thinShells()},
            {"CT-like shells 256^3, bone", accuracy::ctLikeShells(256), boneFunction()},
            {"fog 256^3", fog(256), fogFunction()}};
}

Scene sceneOf(const LitCase& c, double stepVoxels) {
    Scene scene;
    scene.volumes.emplace_back();
    scene.volumes.front().transferFunction = c.function;
    scene.lights = std::vector<Light>{Light{}};
    scene.picture.size = {512, 512};
    scene.quality.stepVoxels = stepVoxels;
    setView(scene, c.volume->grid(), Projection::Orthographic);
    return completed(scene, {c.volume});
}

double processorMs() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

bool measure(renderer::Renderer& renderer, const LitCase& c, double stepVoxels, int frames) {
    Scene looks[3] = {sceneOf(c, stepVoxels), sceneOf(c, stepVoxels), sceneOf(c, stepVoxels)};
    looks[0].lights->clear();
    looks[1].quality.gradients = Gradients::OnTheFly;
    looks[2].quality.gradients = Gradients::Texture;
    ImageF pictures[3];
    double making = 0.0;
    for (int i = 0; i < 3; ++i) {
        auto frame = renderer.render(looks[i], {c.volume});
        if (!frame) {
            std::fprintf(stderr, "%s\n", frame.error().text().c_str());
            return false;
        }
        making = frame->cost.prepareMs;
        pictures[i] = std::move(frame->image);
    }
    std::vector<double> times[3];
    for (int round = 0; round < frames; ++round)
        for (int i = 0; i < 3; ++i) {
            const double before = processorMs();
            if (!renderer.render(looks[i], {c.volume})) return false;
            times[i].push_back(processorMs() - before);
        }
    const double unlit = median(times[0]), onTheFly = median(times[1]), texture = median(times[2]);
    const auto apart = accuracy::difference(pictures[1], pictures[2]).value();
    std::printf("| %s | %.0f | %.0f | %.0f | %.2f | %.2f | %.2g | %.2g | %.0f |\n", c.name.c_str(), unlit,
                onTheFly, texture, onTheFly / unlit, texture / unlit, apart.rmse, apart.maxError, making);
    std::fflush(stdout);
    return true;
}

}  // namespace
}  // namespace pellucid::bench

int main(int argc, char** argv) {
    using namespace pellucid;
    double stepVoxels = 0.5;
    int frames = 7;
    std::vector<std::string> paths;
    CLI::App program("What light costs");
    program.add_option("--step", stepVoxels, "Distance of samples, voxels");
    program.add_option("--frames", frames, "Rounds a median is taken of");
    program.add_option("volumes", paths, "Scans to measure beside the synthetic scenes");
    CLI11_PARSE(program, argc, argv);
    auto renderer = renderer::Renderer::headless();
    if (!renderer) {
        std::fprintf(stderr, "%s\n", renderer.error().text().c_str());
        return 2;
    }
    auto cases = bench::litCases();
    for (const auto& path : paths) {
        const auto loaded = io::loadVolume({path});
        if (loaded)
            cases.push_back({(*loaded)->info().name, *loaded, std::nullopt});
        else
            std::fprintf(stderr, "%s\n", loaded.error().text().c_str());
    }
    std::puts(
        "| Scene | unlit | on the fly | texture | on the fly / unlit | texture / unlit | RMSE between | max "
        "| making, ms |");
    std::puts("|---|--:|--:|--:|--:|--:|--:|--:|--:|");
    bool fine = true;
    for (const auto& c : cases) fine = bench::measure(*renderer, c, stepVoxels, frames) && fine;
    return fine ? 0 : 1;
}
