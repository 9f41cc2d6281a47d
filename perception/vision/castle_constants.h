#pragma once
// Constants of the temporal responses of castleCSF (Ashraf et al. 2024; values of the authors' program, version 0.2.4),
// for castle.cpp and castle_row.cpp.

namespace aleph {

inline constexpr double castle_sustained_power = 1.3314, castle_sustained_scale = 10.5795;
inline constexpr double castle_transient_power = 0.1898, castle_transient_scale = 0.0844836;
inline constexpr double castle_transient_slope = 2.41482,
                        castle_transient_offset = 4.7036;  ///< of the peak over log10 L

}  // namespace aleph
