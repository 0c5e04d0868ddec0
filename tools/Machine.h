// What machine this is.
#pragma once

#include "comparison/HtmlReport.h"

namespace penumbra {

/// Processor, threads, memory, system, compiler, date: what figures of time depend on. What can't
/// be found out is left out.
Facts machineFacts();

} // namespace penumbra
