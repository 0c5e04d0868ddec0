#include "io/usd/layer/UsdDiagnostic.h"

#include <algorithm>

namespace penumbra {

std::string Diagnostic::line() const {
    const std::string times = count > 1 ? " (" + std::to_string(count) + " times)" : "";
    return where.text() + ": warning: " + text + times;
}

void Diagnostics::warn(const SourceLocation& where, const std::string& text, std::size_t count) {
    const std::string key = list_.size() < kMaxTexts || indexOf_.contains(text)
                                ? text
                                : std::string("further warnings of other kinds");
    const auto [entry, isNew] = indexOf_.try_emplace(key, list_.size());
    if (isNew)
        list_.push_back({where, key, count});
    else
        list_[entry->second].count += count;
}

void Diagnostics::append(const std::vector<Diagnostic>& others) {
    for (const Diagnostic& d : others) warn(d.where, d.text, d.count);
}

namespace {

/// Whether something of the scene is missing. All such texts say so in these words.
bool isLoss(const Diagnostic& diagnostic) {
    return diagnostic.text.find("left out") != std::string::npos;
}

} // namespace

std::string summary(const std::vector<Diagnostic>& diagnostics) {
    if (diagnostics.empty()) return {};
    std::vector<const Diagnostic*> byCount;
    std::size_t total = 0;
    for (const Diagnostic& d : diagnostics) {
        byCount.push_back(&d);
        total += d.count;
    }
    std::stable_sort(byCount.begin(), byCount.end(), [](const Diagnostic* a, const Diagnostic* b) {
        if (isLoss(*a) != isLoss(*b)) return isLoss(*a);
        return a->count > b->count;
    });
    std::string text = std::to_string(total) + (total == 1 ? " warning: " : " warnings: ");
    const std::size_t shown = std::min<std::size_t>(3, byCount.size());
    for (std::size_t i = 0; i < shown; ++i) {
        if (i > 0) text += "; ";
        if (byCount[i]->count > 1) text += std::to_string(byCount[i]->count) + " x ";
        text += byCount[i]->text;
    }
    if (shown < byCount.size()) text += "; ...";
    return text;
}

} // namespace penumbra
