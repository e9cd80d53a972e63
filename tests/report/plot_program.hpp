#pragma once

#include "../../src/report/drawing/gnuplot.hpp"

namespace hamjet::io {

/// Whether there is a gnuplot to draw plots with.
inline bool has_gnuplot() { return run_gnuplot("gnuplot", "print 1\n").is_started; }

}  // namespace hamjet::io
