// A small picture, and a disk that is full.
#pragma once

#include "base/FrameLayers.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace penumbra {

/// No file may grow beyond `bytes` while this exists: a disk that is full, without one.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit small{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &small);
    }
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

private:
    void (*handler_)(int);
    rlimit before_{};
};

inline std::string contentOf(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// A picture in which no two values of any layers are equal.
inline FrameLayers sampleFrame(int width = 5, int height = 3) {
    FrameLayers frame(width, height);
    float next = 0.125f;
    const auto rgb = [&] {
        next += 1.11f;
        return Rgb(next, next + 0.37f, next + 0.74f);
    };
    for (std::size_t i = 0; i < frame.pixelCount(); ++i) {
        frame.beauty[i] = rgb();
        frame.alpha[i] = float(i) / float(frame.pixelCount());
        frame.direct[i] = rgb();
        frame.indirect[i] = rgb();
        frame.albedo[i] = rgb();
        frame.illuminance[i] = rgb();
        frame.normal[i] = glm::vec3(rgb().r, -rgb().g, rgb().b);
        frame.depth[i] = 1.0f / 3.0f + float(i);
        frame.objectId[i] = ObjectId{std::uint32_t(100000 + i)}; // beyond half's integers
    }
    frame.depth[0] = FrameLayers::kNoDepth;
    frame.objectId[0] = ObjectId{};
    return frame;
}

} // namespace penumbra
