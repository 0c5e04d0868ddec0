#include "radiosity/query/LitSurface.h"

#include "radiosity/rays/Margins.h"
#include "scenegraph/LitGeometry.h"

#include <algorithm>
#include <numeric>
#include <string>

namespace penumbra {

LitBranch::LitBranch(const PatchSet& patches, const Lighting& light) : Group("radiosity") {
    const std::size_t objects = patches.objects.size();
    std::vector<LitMeshData> data(objects);
    std::vector<std::uint32_t> local(patches.vertices.size(), 0xffffffffu);
    for (LitMeshData& mesh : data) mesh.materials = patches.materials;
    for (std::size_t e = 0; e < patches.elements.size(); ++e) {
        const Element& element = patches.elements[e];
        if (!patches.objects[patches.elementObject[e].value].present) continue;
        LitMeshData& mesh = data[patches.elementObject[e].value];
        const auto vertex = [&](std::uint32_t v, std::size_t corner) {
            if (local[v] == 0xffffffffu) {
                local[v] = std::uint32_t(mesh.positions.size());
                mesh.positions.push_back(patches.vertices[v].position);
                mesh.normals.push_back(patches.vertices[v].receiver.normal);
                mesh.direct.push_back(light.direct[v]);
                mesh.indirect.push_back(light.indirect[v]);
                if (!patches.textures.uvs.empty())
                    mesh.uvs.push_back(patches.textures.uvs[e][corner]);
            }
            return local[v];
        };
        const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
            for (std::size_t k : {a, b, c}) mesh.indices.push_back(vertex(element.vertices[k], k));
            mesh.triangleMaterial.push_back(element.material);
        };
        add(0, 1, 2);
        if (!element.isTriangle()) add(0, 2, 3);
    }
    // By path: of faces in one place the first is seen, whatever was meshed anew before.
    std::vector<std::size_t> order(objects);
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::ranges::stable_sort(
        order, {}, [&](std::size_t o) -> const std::string& { return patches.objects[o].path; });
    for (const std::size_t o : order) {
        if (data[o].indices.empty()) continue;
        add(std::make_shared<LitGeometry>(patches.objects[o].path, ObjectId{std::uint32_t(o)},
                                          std::move(data[o])));
    }
}

LitSurface::LitSurface(const PatchSet& patches, const Lighting& light)
    : patches_(patches), light_(light), surface_(patches) {}

std::optional<SurfaceSample> LitSurface::sample(glm::vec3 origin, glm::vec3 direction,
                                                float reach) const {
    const DrawnHit hit = surface_.nearest(origin, direction, reach);
    if (!hit.met()) return std::nullopt;
    SurfaceSample sample;
    sample.element = hit.element;
    sample.distance = hit.distance;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = hit.vertices[k];
        sample.position += hit.weights[k] * patches_.vertices[v].position;
        sample.normal += hit.weights[k] * patches_.vertices[v].receiver.normal;
        sample.direct += hit.weights[k] * light_.direct[v];
        sample.indirect += hit.weights[k] * light_.indirect[v];
    }
    sample.normal = glm::normalize(sample.normal);
    const LitMaterial surface = surfaceAt(patches_, hit.element, uvOf(patches_, hit));
    sample.reflectance = surface.reflectance;
    sample.emission = surface.emission;
    return sample;
}

std::optional<SurfaceSample> LitSurface::trace(glm::vec3 origin, glm::vec3 direction) const {
    return sample(origin, direction, 1e30f);
}

std::optional<SurfaceSample> LitSurface::under(glm::vec3 position, glm::vec3 normal) const {
    // Close enough not to land on a sheet of paper that covers the sensor, far enough for rounding.
    const float height = 2 * hoverAt(patches_.skin, position);
    return sample(position + height * normal, -normal, 4 * height);
}

} // namespace penumbra
