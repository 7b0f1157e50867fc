#pragma once
// Writes a step's spans in the Trace Event Format, which chrome://tracing and ui.perfetto.dev show
// as one bar a span, one row a thread.

#include <span>
#include <string>

#include "cairn/trace.h"

namespace cairn::scene {

/// The JSON of a trace whose time begins with its earliest span, in microseconds.
std::string trace_to_json(std::span<const TraceSpan> spans);

}  // namespace cairn::scene
