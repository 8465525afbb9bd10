// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// From a folder of DICOM files to a picture, beside the time that DCMTK alone takes to decode the files on
// all cores; and what the process takes of memory.
//
//   opening FOLDER
//
// Run it twice: the second time the files come from memory and the driver has its compiled shaders.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmjpeg/djdecode.h>
#include <dcmtk/dcmjpls/djdecode.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>

#include "bench/render_thread.h"
#include "io/dicom_series.h"
#include "io/load.h"
#include "renderer/renderer.h"
#include "scene/histogram.h"

namespace pellucid::bench {
namespace {

using Clock = std::chrono::steady_clock;

double msSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Pixels of all files, on all cores, as DCMTK gives them.
double decodeMs(const std::vector<std::filesystem::path>& files) {
    const auto start = Clock::now();
    std::atomic<std::size_t> next{0};
    std::atomic<int> bad{0};
    const auto work = [&] {
        for (std::size_t i = next++; i < files.size(); i = next++) {
            DcmFileFormat file;
            const Uint16* pixels = nullptr;
            const bool good =
                file.loadFile(files[i].c_str()).good() &&
                file.getDataset()->chooseRepresentation(EXS_LittleEndianExplicit, nullptr).good() &&
                file.getDataset()->findAndGetUint16Array(DCM_PixelData, pixels).good();
            if (!good) ++bad;
        }
    };
    {
        std::vector<std::jthread> helpers;
        for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) helpers.emplace_back(work);
        work();
    }
    if (bad > 0) fmt::print(stderr, "{} files cannot be decoded\n", bad.load());
    return msSince(start);
}

void printMemory() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmHWM:") || line.starts_with("RssFile:")) fmt::print("  {}\n", line);
}

/// As the desktop's first picture: default look, a quarter of the size and twice the step.
Result<renderer::Frame> firstPicture(renderer::Renderer& renderer, const VolumePtr& volume,
                                     double stepVoxels) {
    Scene scene = completed(Scene{}, {volume});
    scene.picture.size = {256, 192};
    scene.quality.stepVoxels = stepVoxels;
    return renderer.render(scene, {volume});
}

int run(const std::filesystem::path& folder) {
    RenderThread thread;
    std::optional<renderer::Renderer> renderer;
    thread.run([&] {
        if (auto made = renderer::Renderer::headless()) renderer.emplace(std::move(*made));
    });
    if (!renderer) return 2;
    const auto start = Clock::now();
    io::LoadOptions options;
    std::jthread drawing;  // The files are decoded at the same time.
    options.coarse = [&](const VolumePtr& coarse) {
        fmt::print("coarse copy        {:7.1f} ms\n", msSince(start));
        drawing = std::jthread([&, coarse] {
            thread.run([&] { (void)firstPicture(*renderer, coarse, 1.0); });
            fmt::print("its picture        {:7.1f} ms\n", msSince(start));
        });
    };
    const auto volume = io::loadVolume({folder}, options);
    if (!volume) {
        fmt::print(stderr, "{}\n", volume.error().text());
        return 2;
    }
    fmt::print("volume             {:7.1f} ms\n", msSince(start));
    const auto histogram = computeHistogram(**volume, 0, 512, {});
    fmt::print("histogram          {:7.1f} ms\n", msSince(start));
    if (drawing.joinable()) drawing.join();
    renderer::FrameCost cost;
    std::string plan;
    thread.run([&] {
        if (const auto frame = firstPicture(*renderer, *volume, 1.0)) {
            cost = frame->cost;
            plan = fmt::format("{:.1f} MiB main, {:.1f} MiB GPU",
                               static_cast<double>(frame->plan.mainBytes) / 1048576.0,
                               static_cast<double>(frame->plan.totalBytes) / 1048576.0);
        }
    });
    fmt::print("picture of all     {:7.1f} ms (of it upload, tables and compilation {:.1f})\n",
               msSince(start), cost.prepareMs);
    fmt::print("memory: volume {:.1f} MiB, plan {}\n",
               static_cast<double>((*volume)->bytes().size()) / 1048576.0, plan);
    printMemory();
    thread.run([&] { renderer.reset(); });

    DJDecoderRegistration::registerCodecs();
    DJLSDecoderRegistration::registerCodecs();
    std::vector<double> decoded;
    const auto scan = io::scanDicom({folder});
    for (int i = 0; i < 5 && scan; ++i) decoded.push_back(decodeMs(scan->series.front().files));
    std::sort(decoded.begin(), decoded.end());
    if (!decoded.empty())
        fmt::print("DCMTK alone decodes {:6.1f} ms (median of 5)\n", decoded[decoded.size() / 2]);
    return 0;
}

}  // namespace
}  // namespace pellucid::bench

int main(int argc, char** argv) {
    if (argc == 2) return pellucid::bench::run(argv[1]);
    fmt::print(stderr, "opening FOLDER\n");
    return 1;
}
