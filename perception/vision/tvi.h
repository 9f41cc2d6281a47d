#pragma once
// Threshold versus intensity (Ward-Larson, Rushmeier and Piatko 1997): the least visible luminance difference of an eye
// that is adapted to a luminance.

#include <cstddef>

namespace aleph {

/// `count` values, cd/m2 to cd/m2, within 1e-5. Every input gives a finite positive result: below 1e-6 and for NaN that
/// of 1e-6, above 1e12 that of 1e12.
void tvi_row(const float* luminance, std::size_t count, float* out);

}  // namespace aleph
