#pragma once
// Bytes in memory as a stream of OpenEXR.

#include <OpenEXR/ImfIO.h>

#include <cstring>
#include <stdexcept>

#include "engine/image/codec.h"

namespace aleph {

class MemoryInput : public Imf::IStream {
  public:
    explicit MemoryInput(ByteView bytes) : Imf::IStream("memory"), bytes_(bytes) {}

    bool read(char c[], int n) override {
        const auto count = static_cast<std::size_t>(n);
        if (n < 0 || position_ > bytes_.size() || count > bytes_.size() - position_) {
            throw std::runtime_error("the file is cut");
        }
        std::memcpy(c, bytes_.data() + position_, count);
        position_ += count;
        return position_ < bytes_.size();
    }
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override { position_ = position; }

  private:
    ByteView bytes_;
    std::size_t position_ = 0;
};

}  // namespace aleph
