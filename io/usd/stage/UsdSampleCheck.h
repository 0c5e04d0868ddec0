// What is wrong with time samples that are not shown yet.
#pragma once

#include "io/usd/layer/UsdDiagnostic.h"
#include "io/usd/stage/UsdAttributes.h"

#include <functional>
#include <set>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace penumbra {

/// Reads attributes again at all their samples but those that the load has read, and warns of what
/// it finds there. A property of a layer is gone through once a reader, however many prims share
/// it.
class UsdSampleCheck {
public:
    /// Reads one prim at one time and warns of what it can't use.
    using Read = std::function<void(const UsdAttributes&, Diagnostics&)>;

    /// \param loaded when the scene was read
    UsdSampleCheck(UsdTime loaded, Diagnostics& diagnostics)
        : loaded_(loaded), diagnostics_(diagnostics) {}

    /// Warns of each sample, with its time code. \param reader name of `read`
    void each(const UsdPrim& prim, std::span<const std::string_view> attributes,
              std::string_view reader, const Read& read);
    /// Warns of each kind of fault, where it comes first; not of those that the load has found.
    void firsts(const UsdPrim& prim, std::span<const std::string_view> attributes,
                std::string_view reader, const Read& read);

private:
    std::vector<double> times(const UsdPrim& prim, std::span<const std::string_view> attributes,
                              std::string_view reader);
    void warn(const Diagnostic& found, double time);

    UsdTime loaded_;
    Diagnostics& diagnostics_;
    std::set<std::pair<const UsdProperty*, std::string_view>> seen_;
};

} // namespace penumbra
