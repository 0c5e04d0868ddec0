// The selected object: lights, paint, and why it is dark where it was clicked.
#include "radiosity/query/LightProbe.h"
#include "viewer/panels/PanelState.h"
#include "viewer/panels/Panels.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace penumbra {

namespace {

/// A colour and how bright it is, of a luminance in nit.
bool editLuminance(const char* name, Rgb& nits) {
    const float most = maxChannel(nits);
    float colour[3] = {1, 1, 1};
    if (most > 0) colour[0] = nits.r / most, colour[1] = nits.g / most, colour[2] = nits.b / most;
    float level = most;
    ImGui::PushID(name);
    bool edited = ImGui::ColorEdit3("colour", colour, ImGuiColorEditFlags_Float);
    edited |=
        ImGui::DragFloat("brightness", &level, std::max(1.0f, 0.01f * most), 0, 1e6f, "%.0f cd/m2");
    ImGui::PopID();
    const float largest = std::max({colour[0], colour[1], colour[2], 1e-6f});
    if (edited) nits = Rgb(colour[0], colour[1], colour[2]) * (level / largest);
    return edited;
}

void editLights(Walkthrough& walk, const Selection& selection) {
    for (const auto& light : selection.lights) {
        ImGui::TextUnformatted(light->name().c_str());
        Rgb nits = light->luminance();
        if (editLuminance(light->name().c_str(), nits))
            walk.make({LightEdit{light, light->luminance(), nits}});
    }
}

void editPaint(Walkthrough& walk, const std::shared_ptr<Material>& material) {
    const PaintEdit::Paint before{material->reflectance(), material->emission()};
    PaintEdit::Paint after = before;
    float colour[3] = {before.reflectance.r, before.reflectance.g, before.reflectance.b};
    ImGui::Text("surface %s", material->name().c_str());
    bool edited = ImGui::ColorEdit3("reflects", colour, ImGuiColorEditFlags_Float);
    if (edited) {
        const auto possible = [](float c) {
            return std::clamp(c, 0.0f, Material::kMaxReflectance);
        };
        after.reflectance = {possible(colour[0]), possible(colour[1]), possible(colour[2])};
    }
    if (material->emissive()) edited |= editLuminance("emits", after.emission);
    if (edited) walk.make({PaintEdit{material, before, after}});
}

void explainLight(const Walkthrough& walk, const Selection& selection) {
    if (!ImGui::TreeNode("why is it this dark here?")) return;
    constexpr int kMost = 8;
    int lines = 0;
    for (const EmitterAccount& light :
         probeLight(walk.placed(), walk.rays(), selection.position, selection.normal)) {
        if (!(luminance(light.unoccluded) > 0) || ++lines > kMost) continue;
        ImGui::Text("%s", light.path.c_str());
        ImGui::Text("   %.3g of %.3g lux arrive", double(luminance(light.arrives)),
                    double(luminance(light.unoccluded)));
        for (std::size_t i = 0; i < std::min<std::size_t>(3, light.losses.size()); ++i) {
            const LightLoss& loss = light.losses[i];
            ImGui::TextDisabled("   %.3g lux taken by %s", double(luminance(loss.lux)),
                                walk.placed().objects[loss.object.value].path.c_str());
        }
    }
    if (lines == 0) ImGui::TextDisabled("no direct light on this side");
    ImGui::TreePop();
}

void furnish(Walkthrough& walk) {
    if (ImGui::Button("Duplicate")) walk.perform({Action::duplicate});
    ImGui::SameLine();
    if (ImGui::Button("Hide")) walk.perform({Action::hide});
    ImGui::SameLine();
    if (ImGui::Button("Remove")) walk.perform({Action::remove});
}

} // namespace

void drawSelectionPanel(PanelState& state) {
    Walkthrough& walk = *state.walk;
    if (!walk.selection()) {
        ImGui::TextDisabled("click on something in the picture");
        return;
    }
    const Selection selection = *walk.selection(); // edits may change it
    const bool whole = selection.objectPath.empty() || selection.objectPath == "/" ||
                       selection.objectPath == selection.path;
    ImGui::TextWrapped("%s", (whole ? selection.path : selection.objectPath).c_str());
    if (!whole) ImGui::TextDisabled("clicked on: %s", selection.path.c_str());
    furnish(walk);
    editLights(walk, selection);
    if (selection.material) editPaint(walk, selection.material);
    explainLight(walk, selection);
    ImGui::TextDisabled("undo (Ctrl+Z): %zu, redo (Ctrl+Y): %zu", walk.history().undoable(),
                        walk.history().redoable());
}

} // namespace penumbra
