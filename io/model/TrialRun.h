// Trying what may crash.
#pragma once

#include <functional>

namespace penumbra {

/// Does `work` in a copy of the process, which then ends: whether it came to its end, be it by an
/// exception, within that much processor time [s]. Nothing that it does is seen here. True as well
/// if there can't be a copy.
///
/// The copy has one thread: `work` must not wait for others.
bool survivesTrial(const std::function<void()>& work, unsigned seconds);

} // namespace penumbra
