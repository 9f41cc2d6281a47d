#pragma once
// The container of Ogawa archives: groups and data blocks in a file, read-only. Every offset and count is checked
// before it is used, and no memory is taken for a count that the file only claims.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace aleph {

/// The number that at most 8 bytes hold.
std::uint64_t decode_little_endian(std::span<const std::uint8_t> bytes);

/// Where a group's list of children lies. The empty group has no children and offset 0.
struct OgawaGroup {
    std::uint64_t offset = 0;  ///< bytes from the start of the file
    std::uint64_t size = 0;    ///< children

    bool operator==(const OgawaGroup&) const = default;
};

/// Content of a data block. Properties may share blocks: same offset and size are the same bytes. The empty block has
/// offset 0.
struct OgawaData {
    std::uint64_t offset = 0;
    std::span<const std::uint8_t> bytes;
};

/// Limits the memory that reading a file takes. A small file could ask for all memory: many references may lead to the
/// same block.
class ReadBudget {
  public:
    ReadBudget(std::uint64_t limit, std::string file) : limit_(limit), left_(limit), file_(std::move(file)) {}

    /// Before `count` elements of `size` bytes are read or made. @throws InputError where they no longer fit
    void charge(std::uint64_t count, std::uint64_t size = 1);

  private:
    std::uint64_t limit_, left_;
    std::string file_;
};

class OgawaFile {
  public:
    /// @param file  what messages call it
    /// @throws InputError where it is not a complete Ogawa archive of version 1; the message says so of HDF5 archives
    OgawaFile(std::vector<std::uint8_t> bytes, std::string file);

    const std::string& file() const { return file_; }
    std::uint64_t size() const { return bytes_.size(); }
    OgawaGroup root() const { return root_; }

    bool is_data(const OgawaGroup& parent, std::uint64_t child) const;

    /// @throws InputError where there is no such child, it is of the other kind, or it lies outside the file
    OgawaGroup group(const OgawaGroup& parent, std::uint64_t child) const;
    OgawaData data(const OgawaGroup& parent, std::uint64_t child) const;

    /// @throws InputError that names a byte of the file
    [[noreturn]] void fail(std::uint64_t offset, const std::string& reason) const;

  private:
    std::uint64_t word(std::uint64_t offset) const;
    std::uint64_t child_word(const OgawaGroup& parent, std::uint64_t child) const;
    OgawaGroup group_at(std::uint64_t offset) const;

    std::vector<std::uint8_t> bytes_;
    std::string file_;
    OgawaGroup root_;
};

/// Takes little-endian values off the front of a block, one after another; no alignment is needed.
class OgawaCursor {
  public:
    /// @param what  names the block in messages
    OgawaCursor(std::span<const std::uint8_t> bytes, const std::string& file, std::string what)
        : bytes_(bytes), file_(file), what_(std::move(what)) {}

    bool at_end() const { return position_ == bytes_.size(); }
    std::size_t left() const { return bytes_.size() - position_; }

    /// An unsigned integer of 1 to 8 bytes. @throws InputError where the block ends before it, as all below
    std::uint64_t take_unsigned(std::size_t width);
    double take_double();
    std::string take_text(std::uint64_t length);
    [[noreturn]] void fail(const std::string& reason) const;

  private:
    std::span<const std::uint8_t> take(std::uint64_t length);

    std::span<const std::uint8_t> bytes_;
    std::size_t position_ = 0;
    const std::string& file_;
    std::string what_;
};

}  // namespace aleph
