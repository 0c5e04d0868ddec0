#include "viewer/app/PictureSaver.h"

#include "io/image/Exposure.h"
#include "io/image/ExrWriter.h"

#include <cstdio>
#include <filesystem>

namespace penumbra {

void saveLayers(const std::string& path, const std::string& scene, Renderer& renderer,
                const Group& lit, const View& view, glm::ivec2 size) {
    const FrameLayers frame = renderer.render(lit, view, size.x, size.y);
    ExrMetadata metadata;
    metadata.texts["software"] = "Penumbra";
    metadata.texts["scene"] = scene;
    metadata.texts["units"] = "R, G, B, direct, indirect: cd/m^2; illuminance: lux; Z: m";
    metadata.texts["quality"] = "drawn";
    writeExr(path, frame, view, metadata);
}

std::string freeStem(const std::string& name) {
    for (int number = 1;; ++number) {
        char digits[16];
        std::snprintf(digits, sizeof digits, "-%04d", number);
        std::string stem = name + digits;
        std::error_code unknown; // writing will say what is wrong
        if (!std::filesystem::exists(stem + ".exr", unknown) &&
            !std::filesystem::exists(stem + ".png", unknown))
            return stem;
    }
}

std::string describeExposure(float middleGrey, ToneStyle style) {
    char text[64];
    std::snprintf(text, sizeof text, " (exposure %.2f EV, %s)", exposureValueOf(middleGrey),
                  kToneStyleNames[std::size_t(style)]);
    return text;
}

} // namespace penumbra
