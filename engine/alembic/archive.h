#pragma once
// The tree of an Ogawa archive: objects, their properties, and the times and values of samples. Readers of the schemas
// (transform.cpp, mesh.cpp, ...) turn them into scene elements.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/alembic/ogawa.h"
#include "engine/scene/time_sampling.h"

namespace aleph {

/// Limits of the nesting of objects, and of the number of objects after instances are expanded.
inline constexpr std::size_t max_alembic_depth = 1024;
inline constexpr std::size_t max_alembic_objects = 250000;

/// "key=value;key=value"; on a repeated key the first wins.
using AlembicMetadata = std::map<std::string, std::string, std::less<>>;

/// The value of a key; empty where there is none.
const std::string& metadata_value(const AlembicMetadata& metadata, std::string_view key);

/// How plain values are stored; the order is the format's.
enum class PlainType : std::uint8_t { boolean, u8, i8, u16, i16, u32, i32, u64, i64, f16, f32, f64, text, wide_text };

inline bool is_real(PlainType type) {
    return type == PlainType::f16 || type == PlainType::f32 || type == PlainType::f64;
}

struct AlembicProperty {
    enum class Kind { compound, scalar, array };
    std::string name;
    Kind kind = Kind::compound;
    AlembicMetadata metadata;
    OgawaGroup group;

    // Not of compounds.
    PlainType type = PlainType::boolean;
    std::uint32_t extent = 1;  ///< plain values of one element
    std::uint64_t sample_count = 0;
    std::uint64_t first_changed = 0, last_changed = 0;  ///< samples outside repeat the nearest one and are not stored
    std::size_t time_sampling = 0;                      ///< into AlembicArchive::time_samplings

    bool is_constant() const { return sample_count <= 1 || (first_changed == 0 && last_changed == 0); }
};

struct AlembicCompound {
    std::vector<AlembicProperty> properties;

    /// Null where there is no property of that name.
    const AlembicProperty* find(std::string_view name) const;
    /// The same where it has samples.
    const AlembicProperty* find_sampled(std::string_view name) const;
};

struct AlembicObject {
    std::string name;
    int parent = -1;  ///< into AlembicArchive::objects
    AlembicMetadata metadata;
    OgawaGroup group;
    std::vector<int> children;

    std::string schema() const;  ///< "AbcGeom_Xform_v3", ...; empty: a grouping object
    bool is_instance() const { return metadata_value(metadata, "isInstance") == "1"; }
};

/// The stored samples of a property and their times. Samples before the first and after the last that repeat them are
/// left out. One entry for a constant, none without samples.
struct AlembicSamples {
    TimeSampling sampling;
    std::vector<std::uint64_t> indices;

    double time(std::size_t i) const { return sample_time(sampling, i); }
};

class AlembicArchive {
  public:
    /// Reads the tables and the tree of objects. @throws InputError
    AlembicArchive(std::vector<std::uint8_t> bytes, const std::string& file);

    const std::string& file() const { return ogawa_.file(); }
    const AlembicMetadata& metadata() const { return metadata_; }
    const std::vector<TimeSampling>& time_samplings() const { return time_samplings_; }
    const std::vector<std::uint64_t>& sample_maxima() const { return sample_maxima_; }  ///< per sampling, informative

    /// A parent before its children; the first is the root, whose name is empty.
    const std::vector<AlembicObject>& objects() const { return objects_; }
    std::string path(int object) const;

    /// Properties of an object, and of a compound property. @throws InputError, as all below
    AlembicCompound properties(int object) const;
    AlembicCompound properties(const AlembicProperty& compound) const;
    /// Those of the compound's member of a name; none where it has no such member.
    AlembicCompound properties(const AlembicCompound& compound, std::string_view name) const;

    // One sample; an index beyond the last means the last.
    /// T: float, double (from any number), int (from whole numbers and booleans).
    template <class T>
    std::vector<T> numbers(const AlembicProperty& property, std::uint64_t sample) const;
    std::vector<std::string> texts(const AlembicProperty& property, std::uint64_t sample) const;
    /// Sizes of an array sample along its dimensions, in elements; one dimension where the file gives none.
    std::vector<std::uint64_t> dimensions(const AlembicProperty& property, std::uint64_t sample) const;

    /// Equal for samples that share their storage (offset of the block; 0 where it is empty).
    std::uint64_t storage(const AlembicProperty& property, std::uint64_t sample) const;

    /// @throws InputError where times cannot be told apart
    AlembicSamples samples(const AlembicProperty& property) const;

    /// Charge it before memory is taken for what was read.
    ReadBudget& budget() const { return budget_; }
    [[noreturn]] void fail(int object, const std::string& reason) const;
    [[noreturn]] void fail(const AlembicProperty& property, const std::string& reason) const;

  private:
    void read_time_samplings(const OgawaData& table);
    void read_indexed_metadata(const OgawaData& table);
    void read_objects();
    AlembicCompound read_properties(const OgawaGroup& group) const;
    /// @param number  in the table, or of metadata that stands here, behind a length of `width` bytes
    AlembicMetadata take_metadata(OgawaCursor& cursor, std::uint64_t number, std::size_t width) const;
    OgawaData sample_data(const AlembicProperty& property, std::uint64_t sample) const;

    OgawaFile ogawa_;
    mutable ReadBudget budget_;
    AlembicMetadata metadata_;
    std::vector<TimeSampling> time_samplings_;
    std::vector<std::uint64_t> sample_maxima_;
    std::vector<AlembicMetadata> indexed_metadata_;
    std::vector<AlembicObject> objects_;
};

inline constexpr double same_time = 1e-5;  ///< s; as Alembic takes times for equal

/// The sample at or before a time, the first before all. A sample within same_time after the time counts as reached.
/// @param count  samples, at least 1
std::size_t alembic_floor(const TimeSampling& sampling, std::size_t count, double seconds);

}  // namespace aleph
