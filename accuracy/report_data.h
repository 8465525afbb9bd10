// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

/// What `pellucid report` measures and finds out, as plain values. Errors are in units of what is shown
/// (1 = full range, 1/255 = one grey level), times in milliseconds.
namespace pellucid::accuracy {

/// One way to draw the scene.
struct ReportSetting {
    std::string renderer = "pellucid";  ///< Or "vtk-gpu", "vtk-fixed-point".
    Integrator integrator = Integrator::Exponential;
    Filter filter = Filter::Trilinear;
    Accumulation accumulation = Accumulation::Float32;
    bool jitter = false;
    double stepVoxels = 1.0;
    std::optional<double> tolerance;  ///< Grey levels; the adaptive integrator and `automatic` only.
    bool automatic = false;           ///< Step and integrator are the renderer's choice for the tolerance.
    bool operator==(const ReportSetting&) const = default;
};

/// Drawn by another program's renderer.
[[nodiscard]] inline bool isPeer(const ReportSetting& setting) {
    return setting.renderer != "pellucid";
}

/// What was measured of one setting.
struct Measurement {
    ReportSetting setting;
    double stepMm = 0.0;
    double firstMs = 0.0;  ///< Wall clock of the first frame: compilation, uploads and tables included.
    double wallMs = 0.0;   ///< Median of the warm frames, from the call to the pixels.
    std::optional<double> gpuMs;  ///< Median of the warm frames' draws; peers do not tell theirs.
    int warmFrames = 0;
    std::optional<std::uint64_t> bytes;  ///< GPU memory as planned; peers do not tell theirs.
    double maxError = 0.0;
    double rmse = 0.0;
    double psnr = 0.0;  ///< dB, infinite for equal pictures.
    double ssim = 0.0;
};

/// What a picture is compared with: the same field and light. What a peer cannot be told to do as we do is
/// another scene and no error, as another filter is.
struct ReferenceKind {
    Filter filter = Filter::Trilinear;
    /// Peers: the volume ends at the outer voxel centres, half a voxel inside ours, and shown is what lies
    /// in [0, 1].
    bool peers = false;
    bool lightAtEye = false;  ///< VTK's GPU mapper: a headlight is a point at the eye.
    bool operator==(const ReferenceKind&) const = default;
};

struct ReferenceFacts {
    ReferenceKind kind;
    double reachedBound = 0.0;  ///< Largest difference of its last two pictures.
    double reachedRmse = 0.0;   ///< Root mean square of that difference.
    double stepMm = 0.0;
    double ms = 0.0;
};

/// A homogeneous medium of many layers of one opacity: where an accumulation format stops growing.
struct Stall {
    Accumulation accumulation = Accumulation::Float32;
    double layerOpacity = 0.0;
    int layers = 0;
    double exact = 0.0;  ///< 1 - (1 - a)^n.
    double predicted =
        0.0;  ///< Where a (1 - A) is half a unit in the last place of A, or `exact` before that.
    double drawn = 0.0;
};

struct MachineInfo {
    std::string cpu;
    int cores = 0;
    std::string system;     ///< Kernel name and release.
    std::string driver;     ///< Vendor, device and OpenGL version.
    bool software = false;  ///< The driver draws on the CPU.
    std::string build;      ///< Version, source revision, compiler, build type.
};

/// Which settings are measured, and how.
struct ReportScope {
    std::vector<Integrator> integrators;
    std::vector<Filter> filters;  ///< The scene's own first.
    std::vector<Accumulation> accumulations;
    std::vector<double> steps;       ///< Voxels, coarse to fine.
    std::vector<double> tolerances;  ///< Grey levels, coarse to fine.
    glm::ivec2 pictureSize{0, 0};
    int warmFrames = 5;
    double referenceBound = 1e-5;
    int referenceHalvings = 3;
    bool jitter = true;   ///< With and without jittered starts of rays.
    bool crossed = true;  ///< Every combination; else other filters and formats with one integrator only.
    bool peers = false;
    double mostFrameSeconds = 10.0;       ///< Settings expected to take longer are left out.
    double mostReferenceSeconds = 900.0;  ///< So are filters whose reference is.
    double warmSeconds = 3.0;             ///< After this, one warm frame is enough.
    std::optional<double> budgetSeconds;  ///< Nothing is begun that is not expected to end by then.
    std::vector<std::string> reductions;  ///< Sentences: what was left out to be quick.
};

/// A setting that was not measured.
struct LeftOut {
    ReportSetting setting;
    std::string why;
};

/// Everything measured, before any conclusion.
struct ReportData {
    std::string name;       ///< Of the scene, for people.
    std::string sceneText;  ///< The completed scene without sources.
    std::string sceneHash;  ///< Of that text and the voxels.
    glm::ivec3 voxels{0};
    glm::dvec3 spacingMm{0.0};
    MachineInfo machine;
    ReportScope scope;
    int planned = 0;  ///< Settings in the plan; measurements.size() is less when the report was stopped.
    std::vector<ReferenceFacts> references;
    std::vector<Measurement> measurements;  ///< In the order of the plan.
    std::vector<LeftOut> leftOut;
    std::vector<Stall> stalls;
    std::vector<std::string>
        notes;  ///< What a reader must know: peers that could not be measured, for example.
};

}  // namespace pellucid::accuracy
