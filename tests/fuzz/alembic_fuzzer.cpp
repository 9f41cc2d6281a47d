// Any bytes as an Alembic archive.

#include "engine/alembic/alembic.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return aleph::read_fuzz_file("input.abc", data, size, aleph::append_alembic);
}
