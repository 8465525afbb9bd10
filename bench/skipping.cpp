// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// What passing over empty space saves: each scene with and without, 512 x 512, whole frames from the call to
// the pixels. The pictures of a pair are compared first; they must be the same bits.
//
//   skipping [--volume SCAN] [flags of Google Benchmark]
//
// Pairs are best read from --benchmark_repetitions=7 --benchmark_enable_random_interleaving=true
// --benchmark_report_aggregates_only=true, processor time of all cores ("CPU").
#include <benchmark/benchmark.h>

#include <cstdio>
#include <memory>

#include "accuracy/synthetic.h"
#include "bench/bench_cases.h"
#include "io/load.h"
#include "renderer/renderer.h"
#include "renderer/resources/occupancy.h"

namespace pellucid::bench {
namespace {

struct SkipCase {
    std::string name;
    VolumePtr volume;
    Scene scene;
};

void add(std::vector<SkipCase>& cases, const std::string& name, const VolumePtr& volume,
         const std::optional<TransferFunction1D>& function, Mode mode = Mode::Composite) {
    for (const Projection projection : {Projection::Orthographic, Projection::Perspective})
        for (const bool lit : {false, true}) {
            if (lit && !usesLights(mode)) continue;
            Scene scene;
            scene.volumes.emplace_back();
            scene.volumes.front().transferFunction = function;
            scene.mode = mode;
            scene.lights = lit ? std::vector<Light>{Light{}} : std::vector<Light>{};
            scene.picture.size = {512, 512};
            setView(scene, volume->grid(), projection);
            cases.push_back({name + (lit ? "/lit" : "/unlit") +
                                 (projection == Projection::Orthographic ? "/orthographic" : "/perspective"),
                             volume, completed(scene, {volume})});
        }
}

std::vector<SkipCase> skipCases(const std::string& path) {
    std::vector<SkipCase> cases;
    const VolumePtr shells = accuracy::ctLikeShells(256);
    add(cases, "marschner-lobb-128", accuracy::marschnerLobb(128), thinShells());
    add(cases, "fog-256", fog(256), fogFunction());
    add(cases, "ct-shells-256", shells, boneFunction());
    add(cases, "ct-shells-256-mip", shells, std::nullopt, Mode::Mip);
    if (path.empty()) return cases;
    const auto loaded = io::loadVolume({path});
    if (loaded)
        add(cases, (*loaded)->info().name, *loaded, std::nullopt);
    else
        std::fprintf(stderr, "%s\n", loaded.error().text().c_str());
    return cases;
}

Result<renderer::Frame> draw(renderer::Renderer& renderer, const SkipCase& c, bool skip) {
    Scene scene = c.scene;
    scene.quality.skipEmpty = skip;
    return renderer.render(scene, {c.volume});
}

void registerPair(renderer::Renderer& renderer, const SkipCase& c) {
    for (const bool skip : {false, true}) {
        const auto run = [&renderer, &c, skip](benchmark::State& state) {
            const auto first = draw(renderer, c, skip);  // uploads and compiles
            const auto other = draw(renderer, c, !skip);
            if (!first || !other) return state.SkipWithError((first ? other : first).error().text().c_str());
            if (first->image != other->image) return state.SkipWithError("the pictures differ");
            for (auto _ : state) benchmark::DoNotOptimize(draw(renderer, c, skip));
            state.counters["leaps"] = first->plan.features.skipping == renderer::Skipping::Leaps;
            state.counters["box"] = first->plan.features.skipping != renderer::Skipping::None;
        };
        benchmark::RegisterBenchmark((c.name + (skip ? "/skipping" : "/all")).c_str(), run)
            ->Unit(benchmark::kMillisecond)
            ->MeasureProcessCPUTime();
    }
}

/// What an edit of the transfer function costs before the picture, and what a new volume costs once.
void registerPreparation(const VolumePtr& shells) {
    const glm::ivec3 size(512, 512, 300);
    const VolumePtr ct = accuracy::sampledVolume(axisAlignedGrid(size), VoxelType::Int16, [&](glm::ivec3 i) {
        return shells->stored({i.x / 2, i.y / 2, i.z * 256 / 300});
    });
    benchmark::RegisterBenchmark("block-ranges/512x512x300",
                                 [ct](benchmark::State& state) {
                                     for (auto _ : state)
                                         benchmark::DoNotOptimize(renderer::blockRanges(*ct, 0, 1));
                                 })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
    const renderer::BlockRanges ranges = renderer::blockRanges(*ct, 0, 1);
    benchmark::RegisterBenchmark(
        "occupancy/512x512x300",
        [ranges](benchmark::State& state) {
            const std::vector<ValueRange> shown{{(150.0 + 32768.0) / 65535.0, 1.0}};
            for (auto _ : state)
                benchmark::DoNotOptimize(renderer::occupancyOf(ranges, renderer::ShownQuanta(shown), 0.0));
        })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
}

}  // namespace
}  // namespace pellucid::bench

int main(int argc, char** argv) {
    using namespace pellucid;
    benchmark::Initialize(&argc, argv);
    const std::string path = argc > 2 && std::string(argv[1]) == "--volume" ? argv[2] : "";
    auto renderer = renderer::Renderer::headless();
    if (!renderer) {
        std::fprintf(stderr, "%s\n", renderer.error().text().c_str());
        return 2;
    }
    const auto cases = bench::skipCases(path);
    for (const auto& c : cases) bench::registerPair(*renderer, c);
    bench::registerPreparation(accuracy::ctLikeShells(256));
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
