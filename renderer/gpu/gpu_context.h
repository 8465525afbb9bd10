// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "scene/result.h"

namespace pellucid::renderer {

/// An OpenGL 4.5 core context: an own headless one (EGL without a surface, no X server needed), or the one a
/// window made current.
class GpuContext {
public:
    /// Errors: Gpu, naming what is missing and the Debian package that brings it.
    static Result<GpuContext> headless();
    /// Takes the context that is current on this thread. Errors: Gpu when there is none or it is older
    /// than 4.5.
    static Result<GpuContext> current();

    GpuContext(GpuContext&& other) noexcept;
    GpuContext& operator=(GpuContext&& other) noexcept;
    ~GpuContext();

    /// Makes an own context current on the calling thread; a window's context is the window's business.
    void makeCurrent() const;
    [[nodiscard]] bool isOwn() const { return m_context != nullptr; }

private:
    GpuContext() = default;
    void* m_display = nullptr;  // EGLDisplay
    void* m_context = nullptr;  // EGLContext
};

/// What the driver called an error since the last call, in all contexts of the process. Collected from debug
/// contexts only: PELLUCID_GL_DEBUG=1 in the environment makes them.
[[nodiscard]] std::string takeGlErrors();

}  // namespace pellucid::renderer
