#pragma once

#include "gates.hpp"

namespace gracilis::contact_check {

/// Prints, to stdout, what overlaps at rest.
void print_rest(const Judge& judge);

void print_header();

/// One row; a star behind what misses its gate. With `detail`, also a line per muscle and pair that shows anything.
void print_frame(const Judge& judge, const FrameVerdict& frame, const Verdict& held, bool detail);

/// One line per measure: worst value, frame, muscles. Returns whether all gates hold.
bool print_summary(const Verdict& worst);

}  // namespace gracilis::contact_check
