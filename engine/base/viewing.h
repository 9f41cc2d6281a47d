#pragma once
// How the frames are looked at: what turns pixels into degrees and white into cd/m2.

namespace aleph {

struct ViewingConditions {
    double pixels_per_degree = 31.0;  ///< thesis 5.1.3
    double display_white = 100.0;     ///< cd/m2 of Y = 1; the CSF's constants assume 100 (Daly 1998)
    double frames_per_second = 30.0;  ///< the scene's

    bool operator==(const ViewingConditions&) const = default;
};

}  // namespace aleph
