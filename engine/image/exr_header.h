#pragma once
// Checks an EXR file's header before it is read.

#include <string>

#include "engine/image/codec.h"

namespace aleph {

/// Reads the header by OpenEXRCore, which compares attributes with the file's size. Imf::InputFile takes the memory
/// that an attribute names before it reads it: a file of 4 KB could ask for 2 GB.
/// @param bytes  of the file; null: those of the file of this name
/// @throws InputError
void check_exr_header(const std::string& name, const ByteView* bytes);

}  // namespace aleph
