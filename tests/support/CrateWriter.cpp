#include "tests/support/CrateWriter.h"

namespace penumbra {

namespace {

template <class T>
void append(std::string& out, T value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

} // namespace

std::uint32_t CrateWriter::token(const std::string& text) {
    const auto [place, isNew] = tokenOf_.try_emplace(text, std::uint32_t(tokens_.size()));
    if (isNew) tokens_.push_back(text);
    return place->second;
}

std::uint32_t CrateWriter::string(const std::string& text) {
    const auto [place, isNew] = stringOf_.try_emplace(text, std::uint32_t(strings_.size()));
    if (isNew) strings_.push_back(token(text));
    return place->second;
}

std::uint32_t CrateWriter::path(std::uint32_t parent, const std::string& element, bool property) {
    if (token("") == token(element) || token(element) == 0) token("unused"); // never element 0
    paths_.push_back({element, property, {}});
    paths_[parent].children.push_back(std::uint32_t(paths_.size() - 1));
    return std::uint32_t(paths_.size() - 1);
}

std::uint64_t CrateWriter::arrayHead(std::uint64_t count) {
    const std::uint64_t head = (minor_ < 5 ? 4 : 0) + (minor_ < 7 ? 4 : 8);
    while ((here() + head) % 8 != 0) put(std::uint8_t(0));
    const std::uint64_t at = here();
    if (minor_ < 5) put(std::uint32_t(1));
    if (minor_ < 7)
        put(std::uint32_t(count));
    else
        put(count);
    return at;
}

std::uint64_t CrateWriter::packedArray(int type, const std::vector<std::int32_t>& numbers) {
    const std::uint64_t at = arrayHead(numbers.size());
    if (type >= 7) put('i'); // half, float, double: written as integers
    put(packedIntegers(numbers));
    return array(type, at, true);
}

std::uint64_t CrateWriter::tokens(const std::vector<std::string>& names) {
    const std::uint64_t at = here();
    put(std::uint64_t(names.size()));
    for (const std::string& name : names) put(token(name));
    return rep(41, at);
}

std::uint64_t CrateWriter::listOp(int type, unsigned bit, const std::vector<std::uint32_t>& items) {
    const std::uint64_t at = here();
    put(std::uint8_t(bit == 2 ? 3 : bit)).put(std::uint64_t(items.size()));
    for (const std::uint32_t item : items) put(item);
    return rep(type, at);
}

std::uint64_t CrateWriter::samples(const std::vector<double>& times,
                                   const std::vector<std::uint64_t>& reps) {
    const std::uint64_t vector = here();
    put(std::uint64_t(times.size()));
    for (const double time : times) put(time);
    const std::uint64_t timesRep = here();
    put(rep(48, vector));
    put(std::int64_t(8)); // the values follow
    put(std::uint64_t(reps.size()));
    for (const std::uint64_t one : reps) put(one);
    const std::uint64_t at = here();
    put(std::int64_t(timesRep) - std::int64_t(at));
    return rep(46, at);
}

std::uint32_t CrateWriter::fieldSet(const Fields& fields) {
    const auto set = std::uint32_t(fieldSets_.size());
    for (const auto& [name, value] : fields) {
        fieldSets_.push_back(std::int32_t(fields_.size()));
        fields_.emplace_back(token(name), value);
    }
    fieldSets_.push_back(-1);
    return set;
}

void CrateWriter::spec(std::uint32_t path, std::uint32_t form, const Fields& fields) {
    rawSpec(path, fieldSet(fields), form);
}

std::string CrateWriter::packed(std::string_view bytes) {
    std::string out(1, '\0'); // one block
    out += char(bytes.size() < 15 ? bytes.size() << 4 : 0xf0);
    if (bytes.size() >= 15) {
        std::size_t more = bytes.size() - 15;
        for (; more >= 255; more -= 255) out += char(255);
        out += char(more);
    }
    return out.append(bytes);
}

// Differences of 1 are the commonest; others are int8, int16 or int32 literals.
std::string CrateWriter::packedIntegers(const std::vector<std::int32_t>& numbers) {
    std::string codes((numbers.size() + 3) / 4, '\0'), literals;
    std::uint32_t last = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto difference = std::int32_t(std::uint32_t(numbers[i]) - last);
        last = std::uint32_t(numbers[i]);
        unsigned code = 3;
        if (difference == 1)
            code = 0;
        else if (difference == std::int8_t(difference))
            code = 1, append(literals, std::int8_t(difference));
        else if (difference == std::int16_t(difference))
            code = 2, append(literals, std::int16_t(difference));
        else
            append(literals, difference);
        codes[i / 4] = char(std::uint8_t(codes[i / 4]) | code << (2 * (i % 4)));
    }
    std::string plain;
    append(plain, std::int32_t(1));
    const std::string buffer = numbers.empty() ? "" : packed(plain + codes + literals);
    std::string out;
    append(out, std::uint64_t(buffer.size()));
    return out + buffer;
}

std::string CrateWriter::tokenSection() const {
    std::string text, out;
    for (const std::string& token : tokens_) text += token + '\0';
    append(out, std::uint64_t(tokens_.size()));
    append(out, std::uint64_t(text.size()));
    if (minor_ < 4) return out + text;
    const std::string buffer = packed(text);
    append(out, std::uint64_t(buffer.size()));
    return out + buffer;
}

std::string CrateWriter::fieldSection() const {
    std::string out, reps;
    append(out, std::uint64_t(fields_.size()));
    std::vector<std::int32_t> names;
    for (const auto& [name, value] : fields_) {
        names.push_back(std::int32_t(name));
        append(reps, value);
        if (minor_ < 4) {
            append(out, std::uint32_t(0));
            append(out, name);
            append(out, value);
        }
    }
    if (minor_ < 4) return out;
    out += packedIntegers(names);
    const std::string buffer = packed(reps);
    append(out, std::uint64_t(buffer.size()));
    return out + buffer;
}

std::string CrateWriter::integerSection(const std::vector<std::int32_t>& numbers) const {
    std::string out;
    append(out, std::uint64_t(numbers.size()));
    if (minor_ >= 4) return out + packedIntegers(numbers);
    for (const std::int32_t number : numbers) append(out, number);
    return out;
}

std::string CrateWriter::specSection() const {
    std::string out;
    append(out, std::uint64_t(specs_.size()));
    std::vector<std::int32_t> paths, sets, forms;
    for (const Spec& spec : specs_) {
        paths.push_back(std::int32_t(spec.path));
        sets.push_back(std::int32_t(spec.set));
        forms.push_back(std::int32_t(spec.form));
        if (minor_ >= 4) continue;
        if (minor_ == 0) append(out, std::uint32_t(0));
        append(out, spec);
    }
    if (minor_ < 4) return out;
    return out + packedIntegers(paths) + packedIntegers(sets) + packedIntegers(forms);
}

// Depth first; a stack of what is still to be written, with the item that waits for its sibling.
void CrateWriter::pathItems(std::vector<std::int32_t>& index, std::vector<std::int32_t>& element,
                            std::vector<std::int32_t>& jump) {
    struct Open {
        std::uint32_t path;
        bool sibling;         // more of its siblings follow
        std::int64_t waiting; // the item whose jump leads here, or -1
    };
    std::vector<Open> open{{0, false, -1}};
    while (!open.empty()) {
        const Open now = open.back();
        open.pop_back();
        const auto item = std::int64_t(index.size());
        if (now.waiting >= 0) jump[std::size_t(now.waiting)] = std::int32_t(item - now.waiting);
        const Path& path = paths_[now.path];
        const auto name = std::int32_t(now.path == 0 ? 0 : token(path.element));
        index.push_back(std::int32_t(now.path));
        element.push_back(path.property ? -name : name);
        const bool child = !path.children.empty();
        jump.push_back(child ? -1 : now.sibling ? 0 : -2);
        if (now.sibling && child) { // its sibling is on the stack already: it waits for this item
            open.back().waiting = item;
        }
        for (std::size_t i = path.children.size(); i-- > 0;)
            open.push_back({path.children[i], i + 1 < path.children.size(), -1});
    }
}

void CrateWriter::pathRecords(std::string& out, std::uint64_t start, std::uint32_t path,
                              bool sibling) {
    const Path& one = paths_[path];
    const bool child = !one.children.empty();
    if (minor_ == 0) append(out, std::uint32_t(0));
    append(out, path);
    append(out, path == 0 ? 0u : token(one.element));
    append(out, std::uint32_t((child ? 1 : 0) | (sibling ? 2 : 0) | (one.property ? 4 : 0)));
    const std::size_t place = out.size();
    if (child && sibling) append(out, std::uint64_t(0));
    for (std::size_t i = 0; i < one.children.size(); ++i)
        pathRecords(out, start, one.children[i], i + 1 < one.children.size());
    const std::uint64_t next = start + out.size();
    if (child && sibling) std::memcpy(out.data() + place, &next, sizeof next);
}

std::string CrateWriter::pathSection(std::uint64_t start) {
    std::string out;
    append(out, std::uint64_t(paths_.size()));
    if (minor_ < 4) {
        pathRecords(out, start, 0, false);
        return out;
    }
    append(out, std::uint64_t(paths_.size()));
    std::vector<std::int32_t> index, element, jump;
    pathItems(index, element, jump);
    return out + packedIntegers(index) + packedIntegers(element) + packedIntegers(jump);
}

void CrateWriter::section(const std::string& name, const std::string& bytes) {
    contents_.emplace_back(name, here() + sections_.size(), bytes.size());
    sections_ += bytes;
}

std::string CrateWriter::bytes() {
    for (const Path& path : paths_) token(path.element);
    std::string strings;
    append(strings, std::uint64_t(strings_.size()));
    for (const std::uint32_t one : strings_) append(strings, one);
    section("TOKENS", tokenSection());
    section("STRINGS", strings);
    section("FIELDS", fieldSection());
    section("FIELDSETS", integerSection(fieldSets_));
    section("PATHS", pathSection(here() + sections_.size()));
    section("SPECS", specSection());
    std::string header("PXR-USDC\0\0\0\0\0\0\0\0", 16);
    header[9] = char(minor_);
    if (minor_ == 0) header[10] = 1;
    append(header, here() + sections_.size());
    header.resize(kHeaderBytes);
    std::string out = header + values_ + sections_;
    append(out, std::uint64_t(contents_.size()));
    for (const auto& [name, start, size] : contents_) {
        std::string padded = name;
        padded.resize(16);
        out += padded;
        append(out, start);
        append(out, size);
    }
    return out;
}

} // namespace penumbra
