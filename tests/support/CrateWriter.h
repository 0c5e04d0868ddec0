// Crate files for tests and benches, of any version that there is, and broken where a test wants.
#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace penumbra {

/// Builds a crate file byte by byte, without the reader's code. Packs with literals only, which is
/// valid LZ4 and makes nothing smaller.
class CrateWriter {
public:
    explicit CrateWriter(int minor = 8) : minor_(minor) {}

    std::uint32_t token(const std::string& text);
    std::uint32_t string(const std::string& text);
    /// The root is path 0, and there from the start. \param property an element behind a dot
    std::uint32_t path(std::uint32_t parent, const std::string& element, bool property = false);

    // Representations. ---------------------------------------------------------------------------
    static std::uint64_t rep(int type, std::uint64_t payload) {
        return std::uint64_t(type) << 48 | payload;
    }
    static std::uint64_t inlined(int type, std::uint32_t value) {
        return std::uint64_t(1) << 62 | rep(type, value);
    }
    static std::uint64_t array(int type, std::uint64_t payload, bool compressed = false) {
        return std::uint64_t(1) << 63 | std::uint64_t(compressed) << 61 | rep(type, payload);
    }

    // Values: each returns its offset.
    // -------------------------------------------------------------
    std::uint64_t here() const { return kHeaderBytes + values_.size(); }
    template <class T>
    CrateWriter& put(T value) {
        values_.append(reinterpret_cast<const char*>(&value), sizeof value);
        return *this;
    }
    void put(const std::string& bytes) { values_ += bytes; }
    /// What stands before an array's elements; they begin at a multiple of 8.
    std::uint64_t arrayHead(std::uint64_t count);
    template <class T>
    std::uint64_t plainArray(int type, const std::vector<T>& numbers, std::uint64_t count) {
        const std::uint64_t at = arrayHead(count);
        values_.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T));
        return array(type, at);
    }
    std::uint64_t packedArray(int type, const std::vector<std::int32_t>& numbers);
    /// Token vector: names of children.
    std::uint64_t tokens(const std::vector<std::string>& names);
    /// List edit of u32 items under one bit (1 is added for an explicit one).
    std::uint64_t listOp(int type, unsigned bit, const std::vector<std::uint32_t>& items);
    /// Samples of values that are representations.
    std::uint64_t samples(const std::vector<double>& times, const std::vector<std::uint64_t>& reps);

    // Specs.
    // ---------------------------------------------------------------------------------------
    using Fields = std::vector<std::pair<std::string, std::uint64_t>>;
    void spec(std::uint32_t path, std::uint32_t form, const Fields& fields);
    /// A spec as it stands, whatever it refers to.
    void rawSpec(std::uint32_t path, std::uint32_t set, std::uint32_t form) {
        specs_.push_back({path, set, form});
    }
    std::uint32_t fieldSet(const Fields& fields);

    std::string bytes();

    static std::string packed(std::string_view bytes); ///< a buffer
    static std::string packedIntegers(const std::vector<std::int32_t>& numbers);
    static constexpr std::uint64_t kHeaderBytes = 88;

private:
    struct Path {
        std::string element;
        bool property = false;
        std::vector<std::uint32_t> children;
    };
    struct Spec {
        std::uint32_t path, set, form;
    };
    void section(const std::string& name, const std::string& bytes);
    std::string tokenSection() const;
    std::string fieldSection() const;
    std::string integerSection(const std::vector<std::int32_t>& numbers) const;
    std::string specSection() const;
    std::string pathSection(std::uint64_t start);
    void pathItems(std::vector<std::int32_t>& index, std::vector<std::int32_t>& element,
                   std::vector<std::int32_t>& jump);
    void pathRecords(std::string& out, std::uint64_t start, std::uint32_t path, bool sibling);

    int minor_;
    std::string values_, sections_;
    std::vector<std::string> tokens_;
    std::map<std::string, std::uint32_t> tokenOf_, stringOf_;
    std::vector<std::uint32_t> strings_;
    std::vector<Path> paths_{Path{}};
    std::vector<std::pair<std::uint32_t, std::uint64_t>> fields_;
    std::vector<std::int32_t> fieldSets_;
    std::vector<Spec> specs_;
    std::vector<std::tuple<std::string, std::uint64_t, std::uint64_t>> contents_;
};

} // namespace penumbra
