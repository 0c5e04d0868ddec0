#include "viewer/app/PictureSaver.h"

#include "io/image/ExrWriter.h"
#include "io/image/PngWriter.h"

#include <cstdio>
#include <filesystem>
#include <vector>

namespace penumbra {

void savePicture(const Picture& picture, Renderer& renderer, const Group& lit, const View& view) {
    const FrameLayers frame = renderer.render(lit, view, picture.width, picture.height);
    ExrMetadata metadata;
    metadata.texts["software"] = "Penumbra";
    metadata.texts["scene"] = picture.scene;
    metadata.texts["units"] = "R, G, B, direct, indirect: cd/m^2; illuminance: lux; Z: m";
    metadata.texts["quality"] = "drawn";
    writeExr(picture.stem + ".exr", frame, view, metadata);
    const ToneCurve curve(picture.tone);
    std::vector<Rgb> shown(frame.beauty);
    for (Rgb& colour : shown) colour = curve.shown(colour * (kMiddleGrey / picture.middleGrey));
    writePngBytes(picture.stem + ".png", frame.width, frame.height,
                  displayBytes(shown, frame.width));
}

std::string freeStem(const std::string& name) {
    for (int number = 1;; ++number) {
        char digits[16];
        std::snprintf(digits, sizeof digits, "-%04d", number);
        const std::string stem = name + digits;
        std::error_code unknown; // writing will say what is wrong
        if (!std::filesystem::exists(stem + ".exr", unknown) &&
            !std::filesystem::exists(stem + ".png", unknown))
            return stem;
    }
}

} // namespace penumbra
