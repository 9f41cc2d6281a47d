#pragma once
// Checks an EXR file's header before it is read.

#include <string>

#include "engine/image/codec.h"

namespace aleph {

/// Reads each attribute of the header alone: it has to lie within the file, and to end where its size says.
/// Imf::InputFile takes the memory that an attribute names before it reads it, and goes on where a value ends, whatever
/// its size: a file of 4 KB could ask for 2 GB.
/// @throws InputError
void check_exr_header(ByteView bytes, const std::string& name);

}  // namespace aleph
