#include "tests/io/usd/RandomLayers.h"

#include <random>

namespace penumbra {

namespace {

constexpr int kFiles = 3;

/// Writes layers of few names and many arcs among them.
class RandomLayers {
public:
    explicit RandomLayers(unsigned seed) : random_(seed) {}

    std::string layer(int number) {
        std::string text = "#usda 1.0\n(\n defaultPrim = \"a\"\n";
        if (one(2)) text += " relocates = { " + relocates() + " }\n";
        if (number + 1 < kFiles && one(3))
            text += " subLayers = [" + file(number + 1) + " (offset = 1; scale = 2)]\n";
        text += ")\n";
        for (const char* name : {"a", "b", "c"}) prim(name, 0, text);
        return text;
    }

private:
    bool one(int of) { return random_() % unsigned(of) == 0; }
    std::string path(int shortest = 1) {
        std::string path = "<";
        const int levels = shortest + int(random_() % 2);
        for (int i = 0; i < levels; ++i) path.append(1, '/').append(1, char('a' + random_() % 3));
        return path += '>';
    }
    std::string file(int number) {
        std::string name = std::to_string(number);
        return name.insert(0, 1, '@').append(".usda@");
    }

    std::string relocates() {
        std::string text;
        for (int i = 0; i < 3; ++i) text += path(2) + ": " + (one(5) ? "<>" : path()) + ", ";
        return text;
    }

    std::string arcs() {
        std::string text;
        const auto edit = [&] { return one(2) ? " prepend " : " append "; };
        if (one(3)) text += edit() + ("references = " + target() + "\n");
        if (one(6)) text += edit() + ("payload = " + target() + "\n");
        if (one(4)) text += edit() + ("inherits = " + path() + "\n");
        if (one(5)) text += edit() + ("specializes = " + path() + "\n");
        if (one(3))
            text += " variants = { string v = \"" + std::string(one(2) ? "x" : "y") + "\" }\n";
        if (one(8)) text += " instanceable = true\n";
        return text;
    }

    std::string target() {
        const std::string asset = one(2) ? "" : file(int(random_() % (kFiles + 1)));
        return asset.empty() || !one(3) ? asset + path() : asset;
    }

    void prim(const std::string& name, int depth, std::string& text) {
        text += "def \"" + name + "\" (\n variantSets = \"v\"\n" + arcs() + ")\n{\n";
        text += "int i = 1\nrel r = " + path() + "\n";
        body(depth, text);
        if (one(3)) {
            text += "variantSet \"v\" = {\n\"x\" (\n" + arcs() + ") {\n";
            body(depth, text);
            text += "}\n\"y\" {\n}\n}\n";
        }
        text += "}\n";
    }

    void body(int depth, std::string& text) {
        if (depth < 2)
            for (const char* child : {"a", "b", "c"})
                if (one(3)) prim(child, depth + 1, text);
    }

    std::mt19937 random_;
};

} // namespace

void writeRandomLayers(const TemporaryFolder& folder, unsigned seed) {
    RandomLayers layers(seed);
    for (int i = 0; i < kFiles; ++i) folder.write(std::to_string(i) + ".usda", layers.layer(i));
}

} // namespace penumbra
