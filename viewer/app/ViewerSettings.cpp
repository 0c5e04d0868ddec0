#include "viewer/app/ViewerSettings.h"

#include "base/Error.h"
#include "io/image/AtomicFile.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <type_traits>

namespace penumbra {

namespace {

/// One setting by name: how it is written, and read.
struct Field {
    std::string name;
    std::function<std::string(const ViewerSettings&)> text;
    std::function<void(ViewerSettings&, double)> read;
};

const std::string kRecent = "recent = "; // the rest of the line is a path

std::string decimal(double value) {
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

/// \param lowest,highest what is beyond is not taken
template <class T>
Field field(std::string name, T ViewerSettings::*member, double lowest, double highest) {
    return {std::move(name),
            [member](const ViewerSettings& settings) {
                return decimal(double(
                    static_cast<std::conditional_t<std::is_enum_v<T>, int, T>>(settings.*member)));
            },
            [member, lowest, highest](ViewerSettings& settings, double value) {
                if (!(value >= lowest && value <= highest)) return;
                if constexpr (std::is_enum_v<T>)
                    settings.*member = T(int(value));
                else
                    settings.*member = T(value);
            }};
}

std::vector<Field> fields() {
    using S = ViewerSettings;
    return {field("width", &S::width, 160, 16384),
            field("height", &S::height, 120, 16384),
            field("panels", &S::panels, 0, 1),
            field("tone", &S::tone, 0, 2),
            field("compensation", &S::compensation, -20, 20),
            field("walkSpeed", &S::walkSpeed, 0.01, 1000),
            field("eyeHeight", &S::eyeHeight, 0.01, 1000),
            field("sensitivity", &S::sensitivity, 0.01, 100),
            field("gravity", &S::gravity, 0, 1),
            field("collision", &S::collision, 0, 1),
            field("trigger", &S::trigger, 0, 2)};
}

} // namespace

void addRecent(ViewerSettings& settings, const std::filesystem::path& file) {
    std::error_code failed;
    const std::string path = std::filesystem::absolute(file, failed).lexically_normal().string();
    if (failed || path.find('\n') != std::string::npos) return;
    std::erase(settings.recent, path);
    settings.recent.insert(settings.recent.begin(), path);
    if (settings.recent.size() > kMostRecent) settings.recent.resize(kMostRecent);
}

std::string textOf(const ViewerSettings& settings) {
    std::string text = "# Penumbra's walkthrough; written when it is closed\n";
    for (const Field& field : fields()) text += field.name + " = " + field.text(settings) + "\n";
    for (const std::string& file : settings.recent) text += kRecent + file + "\n";
    return text;
}

ViewerSettings settingsFrom(const std::string& text) {
    ViewerSettings settings;
    const std::vector<Field> known = fields();
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(kRecent) && settings.recent.size() < kMostRecent)
            settings.recent.push_back(line.substr(kRecent.size()));
        std::istringstream words(line);
        std::string name, equals, number;
        if (!(words >> name >> equals >> number) || equals != "=") continue;
        double value = 0;
        const char* const end = number.data() + number.size();
        const auto [at, error] = std::from_chars(number.data(), end, value);
        if (error != std::errc() || at != end) continue;
        for (const Field& field : known)
            if (field.name == name) field.read(settings, value);
    }
    return settings;
}

std::filesystem::path settingsFile() {
    const char* const config = std::getenv("XDG_CONFIG_HOME");
    const char* const home = std::getenv("HOME");
    if (config && config[0] == '/')
        return std::filesystem::path(config) / "penumbra" / "viewer.conf";
    if (home && home[0]) return std::filesystem::path(home) / ".config/penumbra/viewer.conf";
    return {};
}

ViewerSettings loadSettings() {
    std::ifstream file(settingsFile());
    std::ostringstream text;
    text << file.rdbuf();
    return settingsFrom(text.str());
}

bool saveSettings(const ViewerSettings& settings) {
    const std::filesystem::path file = settingsFile();
    if (file.empty()) return false;
    std::error_code failed;
    std::filesystem::create_directories(file.parent_path(), failed);
    try {
        writeFileAtomically(file.string(), textOf(settings));
    } catch (const Error&) {
        return false;
    }
    return true;
}

} // namespace penumbra
