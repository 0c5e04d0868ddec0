#include "io/model/ModelFormat.h"

#include <algorithm>
#include <array>
#include <string>

namespace penumbra {

std::optional<ModelFormat> modelFormatOf(const std::filesystem::path& file) {
    struct Ending {
        std::string_view text;
        ModelFormat format;
    };
    constexpr std::array<Ending, 7> kEndings{{{".gltf", ModelFormat::gltf},
                                              {".glb", ModelFormat::gltf},
                                              {".obj", ModelFormat::obj},
                                              {".fbx", ModelFormat::fbx},
                                              {".ply", ModelFormat::ply},
                                              {".stl", ModelFormat::stl},
                                              {".dae", ModelFormat::collada}}};
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    for (const Ending& known : kEndings)
        if (known.text == ending) return known.format;
    return std::nullopt;
}

const char* nameOf(ModelFormat format) {
    constexpr std::array<const char*, 6> kNames{"glTF", "OBJ", "FBX", "PLY", "STL", "Collada"};
    return kNames[std::size_t(format)];
}

} // namespace penumbra
