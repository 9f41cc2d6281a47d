#pragma once
// Where a property is in an element: for tables of properties.

namespace aleph {

/// The member at the end of a path of members.
template <auto... path, class Element>
constexpr auto& at(Element& element) {
    return (element.*....*path);
}

/// A path's place, for elements that may be changed and those that may not.
template <class Element, class T>
struct Place {
    T& (*find)(Element&);

    T& operator()(Element& element) const { return find(element); }
    const T& operator()(const Element& element) const { return find(const_cast<Element&>(element)); }
};

}  // namespace aleph
