#pragma once
// The program's own header, with a path that aleph's sources use too.

struct OwnPicture {
    int width, height;  // pixels
};
constexpr OwnPicture own_picture{128, 96};
