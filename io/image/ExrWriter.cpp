#include "io/image/ExrWriter.h"

#include "base/Error.h"
#include "io/image/AtomicFile.h"

#include <Imath/ImathMatrix.h>
#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <span>
#include <vector>

namespace penumbra {

namespace {

/// OpenEXR's output kept in memory, since its own file streams lose errors of the last write.
class MemoryStream : public Imf::OStream {
public:
    MemoryStream() : Imf::OStream("memory") {}

    void write(const char* data, int count) override {
        if (bytes_.size() < position_ + std::size_t(count)) bytes_.resize(position_ + count);
        std::memcpy(bytes_.data() + position_, data, std::size_t(count));
        position_ += std::size_t(count);
    }
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override { position_ = position; }
    std::span<const std::byte> bytes() const { return bytes_; }

private:
    std::vector<std::byte> bytes_;
    std::size_t position_ = 0;
};

/// One float channel as it lies in the layers.
struct Channel {
    std::string name;
    const float* first = nullptr;
    std::size_t stride = 1; ///< floats from one pixel to the next
};

std::vector<Channel> colourChannels(const FrameLayers& frame) {
    std::vector<Channel> channels;
    const auto addRgb = [&](const std::string& prefix, const std::vector<Rgb>& layer) {
        channels.push_back({prefix + "R", &layer.data()->r, 3});
        channels.push_back({prefix + "G", &layer.data()->g, 3});
        channels.push_back({prefix + "B", &layer.data()->b, 3});
    };
    addRgb("", frame.beauty);
    channels.push_back({"A", frame.alpha.data(), 1});
    addRgb("direct.", frame.direct);
    addRgb("indirect.", frame.indirect);
    addRgb("albedo.", frame.albedo);
    addRgb("illuminance.", frame.illuminance);
    channels.push_back({"N.X", &frame.normal.data()->x, 3});
    channels.push_back({"N.Y", &frame.normal.data()->y, 3});
    channels.push_back({"N.Z", &frame.normal.data()->z, 3});
    return channels;
}

/// Imath multiplies row vectors from the left and stores rows, glm multiplies column vectors from
/// the right and stores columns: the numbers lie in the same order.
Imath::M44f toImath(const glm::dmat4& matrix) {
    Imath::M44f result;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) result[i][j] = float(matrix[i][j]);
    return result;
}

void addCamera(Imf::Header& header, const View& view) {
    glm::dmat4 flip(1.0); // our camera looks along -Z, OpenEXR's along +Z
    flip[2][2] = -1;
    Imf::addWorldToCamera(header, toImath(flip * view.worldToCamera));

    glm::dmat4 toNdc(1.0); // clip space, x and y in [-w, w] with y up, to [0, w] with y down
    toNdc[0][0] = 0.5;
    toNdc[1][1] = -0.5;
    toNdc[3][0] = toNdc[3][1] = 0.5;
    Imf::addWorldToNDC(header, toImath(toNdc * view.worldToClip()));

    const glm::dmat4& p = view.projection;
    if (p[3][3] != 0) return; // parallel: the screen window is defined for perspective alone
    header.screenWindowWidth() = float(2 / p[0][0]); // at distance 1
    header.screenWindowCenter() = {float(p[2][0] / p[0][0]), float(p[2][1] / p[1][1])};
}

Imf::Header makeHeader(const FrameLayers& frame, const View& view, const ExrMetadata& metadata) {
    Imf::Header header(frame.width, frame.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::addChromaticities(header, Imf::Chromaticities()); // its default is Rec. ITU-R BT.709
    Imf::addWhiteLuminance(header, 1.0f);
    addCamera(header, view);
    for (const auto& [name, text] : metadata.texts) header.insert(name, Imf::StringAttribute(text));
    for (const auto& [name, number] : metadata.numbers)
        header.insert(name, Imf::FloatAttribute(number));
    return header;
}

/// Converts a channel; not-a-number stays, so that a search for it can still find it.
std::vector<Imath::half> toHalf(const Channel& channel, std::size_t count, std::size_t& clamped) {
    std::vector<Imath::half> result(count);
    for (std::size_t i = 0; i < count; ++i) {
        const float value = channel.first[i * channel.stride];
        const bool tooLarge = std::abs(value) > HALF_MAX;
        clamped += tooLarge;
        result[i] = tooLarge ? std::copysign(float(HALF_MAX), value) : value;
    }
    return result;
}

/// A slice of the frame buffer; OpenEXR's writer only reads through the pointer.
template <class T>
Imf::Slice slice(Imf::PixelType type, const T* first, std::size_t stride, int width) {
    const std::size_t step = stride * sizeof(T);
    return {type, reinterpret_cast<char*>(const_cast<T*>(first)), step, step * std::size_t(width)};
}

} // namespace

std::size_t writeExr(const std::string& path, const FrameLayers& frame, const View& view,
                     const ExrMetadata& metadata, const ExrOptions& options) {
    assert(frame.width > 0 && frame.height > 0);
    static_assert(sizeof(Rgb) == 3 * sizeof(float) && sizeof(ObjectId) == sizeof(std::uint32_t));
    std::size_t clamped = 0;
    MemoryStream stream;
    try {
        Imf::Header header = makeHeader(frame, view, metadata);
        Imf::FrameBuffer pixels;
        const auto add = [&](const std::string& name, const Imf::Slice& layer) {
            header.channels().insert(name, Imf::Channel(layer.type));
            pixels.insert(name, layer);
        };
        const int width = frame.width;
        std::vector<std::vector<Imath::half>> halves; // what the slices point to
        for (const Channel& channel : colourChannels(frame)) {
            if (options.half) {
                halves.push_back(toHalf(channel, frame.pixelCount(), clamped));
                add(channel.name, slice(Imf::HALF, halves.back().data(), 1, width));
            } else {
                add(channel.name, slice(Imf::FLOAT, channel.first, channel.stride, width));
            }
        }
        add("Z", slice(Imf::FLOAT, frame.depth.data(), 1, width));
        add("objectId", slice(Imf::UINT, &frame.objectId.data()->value, 1, width));

        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(pixels);
        file.writePixels(frame.height);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& exception) {
        throw Error(path + ": error: this picture can't be stored as OpenEXR (try another size; " +
                    "the library gives as its reason: " + exception.what() + ")");
    }
    writeFileAtomically(path, stream.bytes());
    return clamped;
}

} // namespace penumbra
