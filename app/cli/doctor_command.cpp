// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "renderer/renderer.h"

namespace pellucid::app {

namespace {

void row(std::string_view label, const std::string& text) {
    fmt::print("{:<14} {}\n", label, text);
}

constexpr double kSlabMm = 8.0;
constexpr double kExtinctionPerMm = 0.25;

/// A white slab of kSlabMm with one extinction everywhere, seen at right angles on black.
Scene slabScene() {
    Scene scene;
    scene.volumes.emplace_back();
    scene.volumes.front().transferFunction =
        TransferFunction1D{"slab", "", {{0.0, glm::dvec3(1.0), kExtinctionPerMm}}};
    scene.lights.emplace();
    scene.unitLengthMm = 1.0;
    scene.camera.projection = Projection::Orthographic;
    scene.quality.earlyTermination = 0.0;
    scene.picture.size = {17, 17};
    return scene;
}

/// Draws the slab: every ray through it shows 1 - exp(-tau d) (Max 1995, eq. 5 with a constant medium).
Result<void> checkKnownAnswer(renderer::Renderer& renderer) {
    const int n = static_cast<int>(kSlabMm);
    const Result<VolumePtr> slab = Volume::make(axisAlignedGrid({n, n, n}), VoxelType::UInt8, 1,
                                                std::vector<std::byte>(static_cast<std::size_t>(n * n * n)));
    if (!slab) return tl::unexpected(slab.error());
    const Result<renderer::Frame> frame = renderer.render(slabScene(), {*slab});
    if (!frame) return tl::unexpected(frame.error());
    const double expected = -std::expm1(-kExtinctionPerMm * kSlabMm);
    const double found = frame->image.at(8, 8).x;
    // Some tens of segments, each with a few float roundings of 6e-8, and an exponential of the driver's
    // precision: 1e-4 leaves room for coarse drivers and is 40 times finer than one grey level.
    const bool right = std::abs(found - expected) < 1e-4;
    row("Known answer", fmt::format("slab 1 - exp(-{} * {}) = {:.6f}, drawn {:.6f}: {}", kExtinctionPerMm,
                                    kSlabMm, expected, found, right ? "right" : "WRONG"));
    if (right) return {};
    return fail(ErrorCode::Gpu,
                "this driver draws a homogeneous slab wrongly; no picture it draws can be trusted. "
                "Update the graphics driver, or use Mesa's: apt-get install libgl1-mesa-dri libegl-mesa0");
}

int run() {
    row("Pellucid", PELLUCID_VERSION);
    const bool display = std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
    row("Display", display ? "there" : "none: `pellucid PATH` draws to a PNG instead of opening a window");
    Result<renderer::Renderer> renderer = renderer::Renderer::headless();
    if (!renderer) return report(renderer.error());
    const renderer::Renderer::DeviceInfo device = renderer->deviceInfo();
    const renderer::DeviceLimits limits = renderer->limits();
    row("OpenGL", device.version);
    row("Driver",
        fmt::format("{}, {}{}", device.vendor, device.renderer,
                    device.software ? " (in software: correct, and slower than a graphics card)" : ""));
    row("Limits",
        fmt::format(
            "3D textures up to {0}^3 voxels and {1:.1f} GiB, pictures {2}x{2}, uniform blocks {3} bytes",
            limits.max3dTextureSize, static_cast<double>(limits.maxTextureBytes) / 0x1p30,
            device.maxTextureSize, device.maxUniformBlockBytes));
    if (const Result<void> answer = checkKnownAnswer(*renderer); !answer) return report(answer.error());
    fmt::print("All is well.\n");
    return kExitOk;
}

}  // namespace

Command addDoctorCommand(CLI::App& program) {
    CLI::App* command = program.add_subcommand("doctor", "Checks that this machine draws, and draws right");
    command->footer(
        "Tells the OpenGL version, driver and limits, and draws a picture whose answer is known. Exit status "
        "0 when all is\n"
        "well, 3 when not, with what to install.");
    return {command, [] { return run(); }};
}

}  // namespace pellucid::app
