// Trying what may crash.
#pragma once

#include <functional>

namespace penumbra {

/// Does `work` in a copy of the process, which then ends: whether it came to its end, be it by an
/// exception, within so much processor time and so much time by the clock [s]. Nothing that it does
/// is seen here. True as well if there can't be a copy.
///
/// The copy has one thread: `work` that waits for others fails when its time is up.
bool survivesTrial(const std::function<void()>& work, unsigned seconds, unsigned byTheClock);

} // namespace penumbra
