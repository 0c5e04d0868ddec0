#include "viewer/gl/OffscreenContext.h"

#include "base/Error.h"
#include "base/MemoryError.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <dlfcn.h>

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace penumbra {

namespace {

[[noreturn]] void fail(const std::string& reason) {
    throw Error("off-screen rendering: " + reason +
                " (install EGL and OpenGL 3.3; on Debian: apt install libegl1 libgl1-mesa-dri)");
}

/// libepoxy ends the whole program when a library is missing, so search for them before it does.
void requireLibrary(std::initializer_list<const char*> anyOf) {
    for (const char* name : anyOf)
        if (dlopen(name, RTLD_LAZY | RTLD_LOCAL)) return; // stays loaded; epoxy loads it anyway
    fail(std::string("can't load ") + *anyOf.begin());
}

bool listed(const char* extensions, std::string_view name) {
    const std::string_view all = extensions ? extensions : "";
    for (std::size_t at = all.find(name); at != std::string_view::npos;
         at = all.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        if ((at == 0 || all[at - 1] == ' ') && (end == all.size() || all[end] == ' ')) return true;
    }
    return false;
}

/// Every display worth trying: graphics cards before Mesa's software. Asking for one opens no
/// connection yet.
std::vector<EGLDisplay> candidateDisplays() {
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    std::vector<EGLDisplay> displays;
    const auto add = [&](EGLDisplay display) {
        if (display != EGL_NO_DISPLAY) displays.push_back(display);
    };
    if (listed(extensions, "EGL_EXT_platform_device") &&
        (listed(extensions, "EGL_EXT_device_base") ||
         (listed(extensions, "EGL_EXT_device_enumeration") &&
          listed(extensions, "EGL_EXT_device_query")))) {
        std::array<EGLDeviceEXT, 16> devices;
        EGLint count = 0;
        if (eglQueryDevicesEXT(EGLint(devices.size()), devices.data(), &count))
            for (const EGLDeviceEXT device : std::span(devices).first(std::size_t(count)))
                if (!listed(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS),
                            "EGL_MESA_device_software"))
                    add(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
    }
    if (listed(extensions, "EGL_MESA_platform_surfaceless"))
        add(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    add(eglGetDisplay(EGL_DEFAULT_DISPLAY));
    return displays;
}

EGLContext createCoreContext(EGLDisplay display) {
    const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0) return EGL_NO_CONTEXT;
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION_KHR,
                                 3,
                                 EGL_CONTEXT_MINOR_VERSION_KHR,
                                 3,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK_KHR,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT_KHR,
                                 EGL_NONE};
    return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
}

} // namespace

/// Displays are shared by all contexts of a process, and eglTerminate() would take them from all:
/// so they are left open, and only the context is destroyed.
struct OffscreenContext::Impl {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;

    ~Impl() {
        if (context == EGL_NO_CONTEXT) return;
        if (eglGetCurrentContext() == context)
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display, context);
    }

    /// Whether `candidate` gives a context that can be current without a surface.
    bool open(EGLDisplay candidate) {
        if (!eglInitialize(candidate, nullptr, nullptr)) return false;
        if (!listed(eglQueryString(candidate, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context"))
            return false;
        if (!eglBindAPI(EGL_OPENGL_API)) return false;
        const EGLContext created = createCoreContext(candidate);
        if (created == EGL_NO_CONTEXT) return false;
        if (!eglMakeCurrent(candidate, EGL_NO_SURFACE, EGL_NO_SURFACE, created)) {
            eglDestroyContext(candidate, created);
            return false;
        }
        display = candidate;
        context = created;
        return true;
    }
};

OffscreenContext::OffscreenContext(std::size_t pixels) : impl_(std::make_unique<Impl>()) {
    requireMemoryToDraw(pixels);
    requireLibrary({"libEGL.so.1"});
    requireLibrary({"libOpenGL.so.0", "libGL.so.1"});
    for (EGLDisplay display : candidateDisplays())
        if (impl_->open(display)) return;
    fail("no EGL display gives an OpenGL 3.3 core context");
}

OffscreenContext::~OffscreenContext() = default;

void OffscreenContext::makeCurrent() {
    if (eglGetCurrentContext() == impl_->context) return;
    if (!eglBindAPI(EGL_OPENGL_API) ||
        !eglMakeCurrent(impl_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, impl_->context))
        throw Error("off-screen rendering: the context is in use by another thread");
}

std::string OffscreenContext::description() const {
    const int version = epoxy_gl_version(); // 10 * major + minor
    return std::string(reinterpret_cast<const char*>(glGetString(GL_RENDERER))) + ", OpenGL " +
           std::to_string(version / 10) + "." + std::to_string(version % 10);
}

} // namespace penumbra
