#pragma once
// Indices: how elements of a scene refer to each other, and enumerators as positions in a list.

#include <cstddef>
#include <type_traits>

namespace aleph {

/// Index of an element that refers to none.
inline constexpr int no_index = -1;

/// Position of an enumerator in a list that has one entry per enumerator, in the enumeration's order.
template <class Enum>
constexpr std::size_t index_of(Enum value) {
    static_assert(std::is_enum_v<Enum>);
    return static_cast<std::size_t>(value);
}

}  // namespace aleph
