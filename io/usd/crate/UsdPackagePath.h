// Identifiers of files in packages: `a.usdz[b/c.usd]`, `a.usdz[b.usdz[c.usd]]`.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace penumbra {

/// A file in a package: the innermost package that holds it, and its name there.
struct UsdPackagePath {
    std::string package; ///< `a.usdz`, or `a.usdz[b.usdz]`
    std::string name;    ///< `c.usd`
};

/// Packages in packages in packages: more than so many are refused.
inline constexpr int kMaxPackageDepth = 8;

/// The parts of an identifier; nothing if it is the path of a plain file. Brackets count only right
/// behind a name that ends in `.usdz`.
std::optional<UsdPackagePath> splitPackagePath(std::string_view identifier);
/// The identifier of a file in a package.
std::string joinPackagePath(std::string_view package, std::string_view name);
/// The path of the file that holds it: all of a plain path.
std::string_view outermostPackage(std::string_view identifier);
/// How many packages are around a file: 0 for a plain one; does not count
/// beyond kMaxPackageDepth + 1.
int packageDepth(std::string_view identifier);

/// `path` as seen from the folder of `from`, both relative to the package's root, without `.` and
/// `..`. Nothing if it leads out.
std::optional<std::string> pathInPackage(std::string_view from, std::string_view path);

} // namespace penumbra
