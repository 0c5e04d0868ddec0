// Values written to and read from a run of bytes; a reader trusts nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace penumbra {

/// Appends values as they lie in memory: program and worker run on the same machine.
class ByteWriter {
public:
    template <class T>
    void put(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        append(&value, sizeof value);
    }
    template <class T>
    void list(std::span<const T> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        put(std::uint64_t(values.size()));
        append(values.data(), values.size_bytes());
    }
    template <class T>
    void list(const std::vector<T>& values) {
        list(std::span<const T>(values));
    }
    void text(std::string_view text) { list(std::span<const char>(text.data(), text.size())); }

    const std::vector<std::byte>& bytes() const { return bytes_; }
    std::vector<std::byte> take() { return std::move(bytes_); }

private:
    void append(const void* from, std::size_t size) {
        const std::size_t end = bytes_.size();
        bytes_.resize(end + size);
        if (size > 0) std::memcpy(bytes_.data() + end, from, size);
    }
    std::vector<std::byte> bytes_;
};

/// Reads what a ByteWriter wrote, or anything else. What lies beyond the end reads as zero or as an
/// empty list, and ok() is false from then on.
class ByteReader {
public:
    explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    template <class T>
    T get() {
        static_assert(std::is_trivially_copyable_v<T>);
        T value{};
        if (bytes_.size() < sizeof value) {
            fail();
            return value;
        }
        std::memcpy(&value, bytes_.data(), sizeof value);
        bytes_ = bytes_.subspan(sizeof value);
        return value;
    }
    template <class T>
    std::vector<T> list() {
        static_assert(std::is_trivially_copyable_v<T>);
        const auto size = get<std::uint64_t>();
        if (size > bytes_.size() / sizeof(T)) {
            fail();
            return {};
        }
        std::vector<T> values(size);
        if (size > 0) std::memcpy(values.data(), bytes_.data(), size * sizeof(T));
        bytes_ = bytes_.subspan(size * sizeof(T));
        return values;
    }
    std::string text() {
        const std::vector<char> letters = list<char>();
        return {letters.begin(), letters.end()};
    }

    /// A number of things of which each takes at least `least` bytes.
    std::size_t count(std::size_t least) {
        const auto size = get<std::uint64_t>();
        if (size <= bytes_.size() / least) return size;
        fail();
        return 0;
    }
    void fail() {
        ok_ = false;
        bytes_ = {};
    }
    bool ok() const { return ok_; }
    bool atEnd() const { return bytes_.empty(); }

private:
    std::span<const std::byte> bytes_;
    bool ok_ = true;
};

} // namespace penumbra
