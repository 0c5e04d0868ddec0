#include "viewer/panels/GuiLayer.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <filesystem>

namespace penumbra {

namespace {

constexpr float kFontPixels = 15; // at 96 dpi
constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

/// Calm and dark, so that the eye stays on the picture.
void setColours() {
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = style.FrameRounding = style.GrabRounding = 4;
    style.WindowBorderSize = 0;
    style.WindowPadding = {10, 10};
    style.Colors[ImGuiCol_WindowBg] = {0.09f, 0.09f, 0.10f, 0.90f};
    style.Colors[ImGuiCol_TitleBgActive] =
        style.Colors[ImGuiCol_TitleBg] = {0.09f, 0.09f, 0.10f, 0.95f};
    const ImVec4 accent{0.80f, 0.55f, 0.25f, 0.75f}; // lamplight
    const ImVec4 soft{0.80f, 0.55f, 0.25f, 0.30f};
    for (const ImGuiCol colour : {ImGuiCol_CheckMark, ImGuiCol_SliderGrab, ImGuiCol_PlotLines,
                                  ImGuiCol_ButtonActive, ImGuiCol_SliderGrabActive})
        style.Colors[colour] = accent;
    for (const ImGuiCol colour :
         {ImGuiCol_Header, ImGuiCol_HeaderHovered, ImGuiCol_HeaderActive, ImGuiCol_Button,
          ImGuiCol_ButtonHovered, ImGuiCol_FrameBgHovered, ImGuiCol_FrameBgActive})
        style.Colors[colour] = soft;
    style.Colors[ImGuiCol_FrameBg] = {0.20f, 0.20f, 0.22f, 0.80f};
}

} // namespace

GuiLayer::GuiLayer(Window& window) : window_(window) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr; // the panels have fixed positions
    ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;
    ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
    ImGui_ImplOpenGL3_Init("#version 330 core");
    scaleTo(window.contentScale());
}

GuiLayer::~GuiLayer() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void GuiLayer::scaleTo(float contentScale) {
    if (contentScale == scale_) return;
    scale_ = contentScale;
    ImGui::GetStyle() = ImGuiStyle();
    setColours();
    ImGui::GetStyle().ScaleAllSizes(contentScale);
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    fonts.Clear();
    std::error_code ignored;
    if (std::filesystem::exists(kFont, ignored)) {
        fonts.AddFontFromFileTTF(kFont, kFontPixels * contentScale);
    } else {
        ImFontConfig config;
        config.SizePixels = 13 * contentScale;
        fonts.AddFontDefault(&config);
    }
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
}

void GuiLayer::begin() {
    scaleTo(window_.contentScale());
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void GuiLayer::end() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool GuiLayer::wantsPointer() const {
    return ImGui::GetIO().WantCaptureMouse;
}

bool GuiLayer::wantsKeyboard() const {
    return ImGui::GetIO().WantTextInput;
}

bool GuiLayer::busy() const {
    return ImGui::IsAnyItemActive();
}

} // namespace penumbra
