// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gpu/gpu_context.h"

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <mutex>
#include <utility>

#include "renderer/gpu/gl_api.h"
// After the OpenGL loader.
#include <epoxy/egl.h>

namespace pellucid::renderer {

namespace {

constexpr const char* kInstallHint =
    "install a driver with OpenGL 4.5 (Debian: libegl1 libgl1-mesa-dri for Mesa, which also draws without a "
    "GPU)";

std::mutex logMutex;
std::string log;

void GLAPIENTRY onMessage(GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* message, const void*) {
    if (type != GL_DEBUG_TYPE_ERROR) return;
    const std::lock_guard lock(logMutex);
    log += fmt::format("{}\n", message);
}

bool wantsDebug() {
    const char* value = std::getenv("PELLUCID_GL_DEBUG");
    return value != nullptr && std::string_view(value) != "0";
}

Result<void> checkVersion() {
    const int version = epoxy_gl_version();
    if (version < 45)
        return fail(ErrorCode::Gpu, fmt::format("OpenGL {}.{} is too old, 4.5 is needed: {}", version / 10,
                                                version % 10, kInstallHint));
    if (wantsDebug()) {
        glEnable(GL_DEBUG_OUTPUT);
        glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        glDebugMessageCallback(onMessage, nullptr);
    }
    return {};
}

EGLDisplay openDisplay() {
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const std::string_view known = extensions != nullptr ? extensions : "";
    // A device first: the vendor drivers have no surfaceless platform; Mesa has both.
    if (known.find("EGL_MESA_platform_surfaceless") != std::string_view::npos) {
        EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
        if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr)) return display;
    }
    if (known.find("EGL_EXT_platform_device") != std::string_view::npos) {
        std::array<EGLDeviceEXT, 16> devices{};
        EGLint count = 0;
        if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count)) {
            for (EGLint i = 0; i < count; ++i) {
                EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT,
                                                              devices[static_cast<std::size_t>(i)], nullptr);
                if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr)) return display;
            }
        }
    }
    EGLDisplay display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr)) return display;
    return EGL_NO_DISPLAY;
}

}  // namespace

Result<GpuContext> GpuContext::headless() {
    EGLDisplay display = openDisplay();
    if (display == EGL_NO_DISPLAY)
        return fail(ErrorCode::Gpu, fmt::format("no EGL display could be opened: {}", kInstallHint));
    if (!eglBindAPI(EGL_OPENGL_API))
        return fail(ErrorCode::Gpu, fmt::format("EGL offers no desktop OpenGL: {}", kInstallHint));
    const std::array<EGLint, 11> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                            4,
                                            EGL_CONTEXT_MINOR_VERSION,
                                            5,
                                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                            EGL_CONTEXT_OPENGL_DEBUG,
                                            wantsDebug() ? EGL_TRUE : EGL_FALSE,
                                            EGL_NONE};
    EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (context == EGL_NO_CONTEXT)
        return fail(ErrorCode::Gpu, fmt::format("no OpenGL 4.5 core context (EGL error {:#x}): {}",
                                                eglGetError(), kInstallHint));
    GpuContext made;
    made.m_display = display;
    made.m_context = context;
    if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
        return fail(ErrorCode::Gpu,
                    fmt::format("the OpenGL context cannot be used without a surface (EGL error {:#x}): {}",
                                eglGetError(), kInstallHint));
    if (auto fine = checkVersion(); !fine) return tl::unexpected(fine.error());
    return made;
}

Result<GpuContext> GpuContext::current() {
    if (eglGetCurrentContext() == EGL_NO_CONTEXT && epoxy_gl_version() == 0)
        return fail(ErrorCode::Gpu, "no OpenGL context is current on this thread");
    if (auto fine = checkVersion(); !fine) return tl::unexpected(fine.error());
    return GpuContext();
}

GpuContext::GpuContext(GpuContext&& other) noexcept
    : m_display(std::exchange(other.m_display, nullptr)),
      m_context(std::exchange(other.m_context, nullptr)) {}

GpuContext& GpuContext::operator=(GpuContext&& other) noexcept {
    std::swap(m_display, other.m_display);
    std::swap(m_context, other.m_context);
    return *this;
}

GpuContext::~GpuContext() {
    if (m_context == nullptr) return;
    if (eglGetCurrentContext() == m_context)
        eglMakeCurrent(m_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(m_display, m_context);
}

void GpuContext::makeCurrent() const {
    if (m_context != nullptr && eglGetCurrentContext() != m_context)
        eglMakeCurrent(m_display, EGL_NO_SURFACE, EGL_NO_SURFACE, m_context);
}

std::string takeGlErrors() {
    const std::lock_guard lock(logMutex);
    return std::exchange(log, {});
}

}  // namespace pellucid::renderer
