#include "io/model/ModelText.h"

#include "base/Error.h"
#include "io/model/ModelCheck.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <sstream>
#include <string>
#include <string_view>

namespace penumbra {

namespace {

constexpr std::size_t kMostElements = 2 * kMostNested; // a node may be two elements deep
constexpr std::size_t kLongestHeader = 65'536;         // of PLY

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
    throw SceneFileError({file.string()}, why + " (export the model again)");
}

bool isBlank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/// Counts the braces of FBX.
class BraceCheck {
public:
    explicit BraceCheck(const std::filesystem::path& file) : file_(file) {}
    void take(char c) {
        if (c == '"') quoted_ = !quoted_;
        if (quoted_) return;
        if (c == '{' && ++depth_ > kMostElements) refuse(file_, "elements are nested too deeply");
        if (c == '}' && depth_ > 0) --depth_;
    }

private:
    const std::filesystem::path& file_;
    bool quoted_ = false;
    std::size_t depth_ = 0;
};

/// Follows the elements of XML.
class XmlCheck {
public:
    explicit XmlCheck(const std::filesystem::path& file) : file_(file) {}

    void take(char c) {
        if (inTag_)
            takeInTag(c);
        else if (c == '<')
            beginTag();
        else if (indices_ && !isBlank(c) && c != '-' && c != '+' && (c < '0' || c > '9'))
            refuse(file_, std::string("in <") + name_ + "> there is something else than indices");
        before_ = c;
    }

private:
    void beginTag() {
        inTag_ = naming_ = true;
        indices_ = false;
        name_.clear();
    }
    void takeInTag(char c) {
        if (c == '>') return endTag();
        if (naming_ && (isBlank(c) || (c == '/' && !name_.empty()))) naming_ = false;
        if (naming_ && name_.size() < 16) name_ += c;
    }
    // `<a>` opens, `</a>` closes; `<a/>`, `<?a?>` and `<!a>` do neither.
    void endTag() {
        inTag_ = false;
        if (name_.starts_with('/')) {
            if (depth_ > 0) --depth_;
        } else if (before_ != '/' && !name_.starts_with('?') && !name_.starts_with('!')) {
            if (++depth_ > kMostElements) refuse(file_, "elements are nested too deeply");
            indices_ = name_ == "p" || name_ == "h" || name_ == "v" || name_ == "vcount";
        }
    }

    const std::filesystem::path& file_;
    std::string name_;
    char before_ = 0;
    bool inTag_ = false, naming_ = false, indices_ = false;
    std::size_t depth_ = 0;
};

template <class Check>
void checkEach(std::string_view text, Check check) {
    for (const char c : text) check.take(c);
}

// `element NAME COUNT`: each takes a byte at least.
void checkPlyElement(const std::filesystem::path& file, std::istringstream& words,
                     std::size_t fileSize) {
    std::string name, count;
    words >> name >> count;
    std::uint64_t number = 0;
    const auto read = std::from_chars(count.data(), count.data() + count.size(), number);
    if (count.empty() || read.ec != std::errc() || read.ptr != count.data() + count.size() ||
        number > fileSize)
        refuse(file, "the header has a wrong number of elements");
}

void checkPlyHeader(const std::filesystem::path& file, std::string_view source) {
    std::string text(source.substr(0, kLongestHeader));
    std::replace(text.begin(), text.end(), '\r', '\n');
    std::istringstream lines(text);
    bool first = true;
    for (std::string line; std::getline(lines, line); first = false) {
        line.erase(line.find_last_not_of(" \t") + 1);
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (first && word != "ply" && word != "PLY") refuse(file, "this is no PLY");
        if (word == "end_header" && line.ends_with(word)) return;
        if (word == "element") checkPlyElement(file, words, source.size());
    }
    refuse(file, "the header has no end");
}

} // namespace

void checkModelText(const std::filesystem::path& file, ModelFormat format, std::string_view text) {
    if (format == ModelFormat::ply) checkPlyHeader(file, text);
    if (format == ModelFormat::collada) checkEach(text, XmlCheck(file));
    if (format == ModelFormat::fbx && !text.starts_with("Kaydara FBX Binary"))
        checkEach(text, BraceCheck(file));
}

} // namespace penumbra
