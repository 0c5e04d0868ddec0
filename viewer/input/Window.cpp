#include "viewer/input/Window.h"

#include "base/Error.h"
#include "base/MemoryError.h"

#include <epoxy/gl.h>

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <utility>

namespace penumbra {

namespace {

constexpr const char* kHint =
    " (penumbra render makes pictures without a window; see penumbra render --help)";

/// GLFW's own words on what went wrong last.
std::string reason() {
    const char* text = nullptr;
    if (glfwGetError(&text) == GLFW_NO_ERROR || !text) return "unknown reason";
    std::string line = text;
    line = line.substr(0, line.find('\n'));
    while (!line.empty() && line.back() == '.') line.pop_back();
    return line;
}

Key keyOf(int code) {
    if (code == GLFW_KEY_SPACE || (code >= GLFW_KEY_0 && code <= GLFW_KEY_9) ||
        (code >= GLFW_KEY_A && code <= GLFW_KEY_Z))
        return Key(std::uint8_t(code));
    if (code >= GLFW_KEY_F1 && code <= GLFW_KEY_F12)
        return Key(std::uint8_t(int(Key::f1) + code - GLFW_KEY_F1));
    if (code >= GLFW_KEY_KP_0 && code <= GLFW_KEY_KP_9)
        return Key(std::uint8_t('0' + code - GLFW_KEY_KP_0));
    constexpr std::array<std::pair<int, Key>, 21> kNamed{{
        {GLFW_KEY_ESCAPE, Key::escape},
        {GLFW_KEY_ENTER, Key::enter},
        {GLFW_KEY_KP_ENTER, Key::enter},
        {GLFW_KEY_TAB, Key::tab},
        {GLFW_KEY_BACKSPACE, Key::backspace},
        {GLFW_KEY_DELETE, Key::remove},
        {GLFW_KEY_LEFT, Key::left},
        {GLFW_KEY_RIGHT, Key::right},
        {GLFW_KEY_UP, Key::up},
        {GLFW_KEY_DOWN, Key::down},
        {GLFW_KEY_PAGE_UP, Key::pageUp},
        {GLFW_KEY_PAGE_DOWN, Key::pageDown},
        {GLFW_KEY_HOME, Key::home},
        {GLFW_KEY_END, Key::end},
        {GLFW_KEY_LEFT_SHIFT, Key::leftShift},
        {GLFW_KEY_RIGHT_SHIFT, Key::rightShift},
        {GLFW_KEY_LEFT_CONTROL, Key::leftControl},
        {GLFW_KEY_RIGHT_CONTROL, Key::rightControl},
        {GLFW_KEY_LEFT_ALT, Key::leftAlt},
        {GLFW_KEY_RIGHT_ALT, Key::rightAlt},
    }};
    const auto found = std::find_if(kNamed.begin(), kNamed.end(),
                                    [&](const auto& named) { return named.first == code; });
    return found == kNamed.end() ? Key::unknown : found->second;
}

/// What is printed on a key, where that is a letter.
char letterOf(int code, int scan) {
    const char* const name = glfwGetKeyName(code, scan);
    if (!name || name[0] == 0 || name[1] != 0) return 0;
    const char upper = char(name[0] >= 'a' && name[0] <= 'z' ? name[0] - 'a' + 'A' : name[0]);
    return upper >= 'A' && upper <= 'Z' ? upper : char(0);
}

Modifiers modifiersOf(int mods) {
    return {(mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_CONTROL) != 0,
            (mods & GLFW_MOD_ALT) != 0};
}

/// Whether the driver says that it forgot everything; where it can't tell, no.
bool contextLost() {
    if (epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_KHR_robustness"))
        return glGetGraphicsResetStatus() != GL_NO_ERROR;
    if (epoxy_has_gl_extension("GL_ARB_robustness"))
        return glGetGraphicsResetStatusARB() != GL_NO_ERROR;
    return false;
}

} // namespace

struct Window::Impl {
    /// GLFW itself, for as long as there is a window.
    struct Library {
        Library() {
            if (!glfwInit()) throw Error("can't open a window: " + reason() + kHint);
        }
        ~Library() { glfwTerminate(); }
        Library(const Library&) = delete;
        Library& operator=(const Library&) = delete;
    };

    explicit Impl(const WindowOptions& options);
    ~Impl() { glfwDestroyWindow(window); }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    static void listen(GLFWwindow* window);
    glm::dvec2 inPixels(double x, double y) const;
    void moveTo(double x, double y);

    static Impl& of(GLFWwindow* window) {
        return *static_cast<Impl*>(glfwGetWindowUserPointer(window));
    }

    Library library;
    GLFWwindow* window = nullptr;
    std::vector<InputEvent> events;
    glm::dvec2 pointer{0.0};
    bool pointerKnown = false;     ///< false: the next position is no movement
    std::array<int, 4> windowed{}; ///< position and size before full screen
};

Window::Impl::Impl(const WindowOptions& options) {
    requireMemoryToDraw(std::size_t(options.width) * std::size_t(options.height));
    const auto tryWith = [&](bool robust) {
        glfwDefaultWindowHints();
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
        glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
        glfwWindowHint(GLFW_DEPTH_BITS, 0);
        if (robust) glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
        window = glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr,
                                  nullptr);
        return window != nullptr;
    };
    if (!tryWith(true) && !tryWith(false))
        throw Error("can't open a window with OpenGL 3.3: " + reason() + kHint);
    glfwMakeContextCurrent(window);
    if (epoxy_gl_version() < 33)
        throw Error(std::string("can't open a window with OpenGL 3.3: this is OpenGL ") +
                    std::to_string(epoxy_gl_version() / 10) + "." +
                    std::to_string(epoxy_gl_version() % 10) + kHint);
    glfwSwapInterval(options.vsync ? 1 : 0);
    glfwSetWindowUserPointer(window, this);
    listen(window);
}

glm::dvec2 Window::Impl::inPixels(double x, double y) const {
    int width = 1, height = 1, columns = 1, rows = 1;
    glfwGetWindowSize(window, &width, &height);
    glfwGetFramebufferSize(window, &columns, &rows);
    return {x * columns / std::max(1, width), y * rows / std::max(1, height)};
}

void Window::Impl::moveTo(double x, double y) {
    const glm::dvec2 now = inPixels(x, y);
    events.push_back(MoveEvent{now, pointerKnown ? now - pointer : glm::dvec2(0)});
    pointer = now;
    pointerKnown = true;
}

void Window::Impl::listen(GLFWwindow* window) {
    glfwSetKeyCallback(window, [](GLFWwindow* w, int code, int scan, int action, int mods) {
        of(w).events.push_back(KeyEvent{keyOf(code), action != GLFW_RELEASE, action == GLFW_REPEAT,
                                        modifiersOf(mods), letterOf(code, scan)});
    });
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned character) {
        of(w).events.push_back(TextEvent{char32_t(character)});
    });
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { of(w).moveTo(x, y); });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int mods) {
        if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
        constexpr std::array<MouseButton, 3> kButtons{MouseButton::left, MouseButton::right,
                                                      MouseButton::middle};
        Impl& impl = of(w);
        if (!impl.pointerKnown) { // GLFW knows where it is by now, events where it was
            double x = 0, y = 0;
            glfwGetCursorPos(w, &x, &y);
            impl.moveTo(x, y);
        }
        impl.events.push_back(ButtonEvent{kButtons[std::size_t(button)], action == GLFW_PRESS,
                                          modifiersOf(mods), impl.pointer});
    });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) {
        const auto held = [&](int left, int right) {
            return glfwGetKey(w, left) == GLFW_PRESS || glfwGetKey(w, right) == GLFW_PRESS;
        };
        of(w).events.push_back(ScrollEvent{{x, y},
                                           {held(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT),
                                            held(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL),
                                            held(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT)}});
    });
    glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
        if (count > 0) of(w).events.push_back(DropEvent{{paths, paths + count}});
    });
    glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int focused) {
        of(w).pointerKnown = false;
        of(w).events.push_back(FocusEvent{focused == GLFW_TRUE});
    });
}

Window::Window(const WindowOptions& options) : impl_(std::make_unique<Impl>(options)) {}

Window::~Window() = default;

void Window::poll(double seconds) {
    if (seconds > 0)
        glfwWaitEventsTimeout(seconds);
    else
        glfwPollEvents();
}

std::vector<InputEvent> Window::takeEvents() {
    return std::exchange(impl_->events, {});
}

void Window::show() {
    glfwSwapBuffers(impl_->window);
    if (contextLost())
        throw Error(std::string("the graphics card was reset and the window is lost; start again") +
                    kHint);
}

void Window::finish() {
    glFinish();
}

bool Window::takeClosing() {
    const bool closing = glfwWindowShouldClose(impl_->window);
    glfwSetWindowShouldClose(impl_->window, GLFW_FALSE);
    return closing;
}

void Window::setTitle(const std::string& title) {
    glfwSetWindowTitle(impl_->window, title.c_str());
}

void Window::capturePointer(bool captured) {
    glfwSetInputMode(impl_->window, GLFW_CURSOR,
                     captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
    double x = 0, y = 0; // jumps back to where it was when it was hidden: no movement
    glfwGetCursorPos(impl_->window, &x, &y);
    impl_->pointer = impl_->inPixels(x, y);
}

bool Window::pointerCaptured() const {
    return glfwGetInputMode(impl_->window, GLFW_CURSOR) == GLFW_CURSOR_DISABLED;
}

void Window::setFullScreen(bool full) {
    auto& [x, y, width, height] = impl_->windowed;
    if (full == fullScreen()) return;
    if (!full) {
        glfwSetWindowMonitor(impl_->window, nullptr, x, y, width, height, GLFW_DONT_CARE);
        return;
    }
    GLFWmonitor* const monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* const mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    if (!mode) return;
    glfwGetWindowPos(impl_->window, &x, &y);
    glfwGetWindowSize(impl_->window, &width, &height);
    glfwSetWindowMonitor(impl_->window, monitor, 0, 0, mode->width, mode->height,
                         mode->refreshRate);
}

bool Window::fullScreen() const {
    return glfwGetWindowMonitor(impl_->window) != nullptr;
}

glm::ivec2 Window::pixels() const {
    glm::ivec2 pixels(0);
    glfwGetFramebufferSize(impl_->window, &pixels.x, &pixels.y);
    return pixels;
}

glm::ivec2 Window::size() const {
    glm::ivec2 size(0);
    glfwGetWindowSize(impl_->window, &size.x, &size.y);
    return size;
}

float Window::contentScale() const {
    float x = 1, y = 1;
    glfwGetWindowContentScale(impl_->window, &x, &y);
    return std::max(x, 0.5f);
}

bool Window::visible() const {
    const glm::ivec2 area = pixels();
    return area.x > 0 && area.y > 0 && !glfwGetWindowAttrib(impl_->window, GLFW_ICONIFIED);
}

std::string Window::renderer() const {
    const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const auto* version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
    return std::string(name ? name : "?") + ", OpenGL " + (version ? version : "?");
}

bool Window::drawnInSoftware() const {
    const std::string name = renderer();
    return name.find("llvmpipe") != std::string::npos ||
           name.find("softpipe") != std::string::npos ||
           name.find("SwiftShader") != std::string::npos;
}

GLFWwindow* Window::handle() const {
    return impl_->window;
}

} // namespace penumbra
