// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "renderer/frame.h"
#include "scene/progress.h"
#include "scene/scene.h"

namespace pellucid::renderer {

class GpuContext;

struct RenderOptions {
    Progress progress;           ///< Asked between tiles; false cancels.
    bool estimateError = false;  ///< Frame::error.
    /// Divides width and height of the pictures the estimate is made from (pictures of 64 pixels are not
    /// reduced). 1 takes four frames' time beside the frame and sees every pixel; 2 takes 5/4 and 4 takes
    /// 5/16 of a frame, about twice that where running integrals stand in for midpoint sums, and the largest
    /// error may be at a pixel they do not see.
    int estimateReduction = 2;
    /// A pre-integration table may be a quick one while the exact one is made (Frame::preview).
    bool allowPreview = false;
    /// With allowPreview: what a picture may spend on the texture of gradients, for those after it; until
    /// that is complete they are computed on the fly.
    double gradientMs = 50.0;
    /// Tiles are sized so that one draw takes about this long; 30 is the stated limit.
    double tileTargetMs = 20.0;
};

/// How often each kind of work was done since the renderer was made (Van Gelder & Kim 1996, section 3: what
/// an event need not recompute is not recomputed).
struct WorkCounts {
    int volumeUploads = 0;
    int transferTables = 0;  ///< Of the function or its running integrals.
    int preintegrationTables = 0;
    int importanceVolumes = 0;
    int programsCompiled = 0;  ///< From text.
    int programsFromDisk = 0;  ///< Driver binaries.
    int frames = 0;
    int blockRanges = 0;    ///< Of a volume's blocks.
    int occupancies = 0;    ///< Of the blocks under a transfer function.
    int fieldTextures = 0;  ///< Of values and gradients.
    bool operator==(const WorkCounts&) const = default;
};

/// Scene + volumes -> Frame. Owns GL objects that live as long as scenes use them, so a second frame uploads
/// nothing. Use from one thread, the one where its context is current.
class Renderer {
public:
    /// A renderer with its own headless context (EGL surfaceless). Errors: Gpu, with what to install.
    static Result<Renderer> headless();
    /// A renderer in the context that is current now and outlives it (a window's).
    static Result<Renderer> inCurrentContext();

    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;
    ~Renderer();

    /// `scene` need not be completed. One volume for each scene.volumes item (or one volume and no item).
    /// Errors: those of makePlan, Gpu (compile error with file, line and driver log; out of memory),
    /// Cancelled.
    [[nodiscard]] Result<Frame> render(const Scene& scene, const std::vector<VolumePtr>& volumes,
                                       const RenderOptions& options = {});

    [[nodiscard]] const WorkCounts& workCounts() const;
    [[nodiscard]] DeviceLimits limits() const;
    /// Counts on no more turns of a pixel's loops than this, as on a driver that gives no more; tests of what
    /// is drawn in slabs need no steps so short.
    void limitLoopTurns(double turns);

    /// What the driver says it is; for doctor, reports and status bars.
    struct DeviceInfo {
        std::string vendor, renderer, version;
        bool software = false;
        int max3dTextureSize = 0;
        int maxUniformBlockBytes = 0;
        int maxTextureSize = 0;
        double maxLoopTurns = 0.0;  ///< DeviceLimits::maxLoopTurns.
    };
    [[nodiscard]] DeviceInfo deviceInfo() const;

private:
    struct State;
    explicit Renderer(std::unique_ptr<State> state);
    std::unique_ptr<State> m_state;
};

}  // namespace pellucid::renderer
