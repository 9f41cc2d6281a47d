#pragma once
// Viewing conditions: size of a pixel and brightness of the display.

namespace aleph {

struct ViewingConditions {
    double pixels_per_degree = 31.0;  ///< pixels per degree of visual angle; thesis 5.1.3
    double display_white = 100.0;     ///< cd/m2 of Y = 1; the CSF's constants assume 100 (Daly 1998)
    /// Share of a frame's time for which the display shows it: 1 holds it (LCD, OLED), a CRT has about 0.1. Used by the
    /// castle model of vision.
    double persistence = 1.0;

    bool operator==(const ViewingConditions&) const = default;
};

}  // namespace aleph
