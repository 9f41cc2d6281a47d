#pragma once
// The parts of the Alembic reader: each reads one schema. Only this folder uses them.

#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/alembic/archive.h"
#include "engine/scene/append.h"

namespace aleph {

struct AlembicReader {
    explicit AlembicReader(const AlembicArchive& source);

    const AlembicArchive& archive;
    std::map<std::pair<int, std::string_view>, int> child_of;  ///< object and name -> object
    Scene part;                                                ///< what was read; indices count from its own elements
    std::map<int, std::vector<int>> meshes_of;                 ///< object -> meshes; instances share them
    std::map<int, int> camera_of;                              ///< object -> camera
    std::map<std::string, int> material_of;                    ///< path as assigned -> material
    double first = std::numeric_limits<double>::infinity(), last = -first;  ///< s, of all that is sampled

    /// Warnings of the same text become one, with the first place and how many more there are.
    void warn(int object, const std::string& text);
    std::vector<std::string> list_warnings() const;

    /// Widens `first` to `last` by the span of a property's samples.
    void widen(const AlembicProperty& property);

  private:
    struct Warning {
        std::string text, place;  ///< the first place
        int count;
    };
    std::vector<Warning> warnings_;
    std::size_t left_out_ = 0;
};

void read_objects(AlembicReader& reader);

/// Fills the node's transform. @param top  the object's properties
void read_transform(AlembicReader& reader, int object, const AlembicCompound& top, Node& node);

/// Meshes of a polygon mesh or of a subdivision surface, one for each topology and material.
/// @param geom  the properties in ".geom"
std::vector<int> read_polygon_mesh(AlembicReader& reader, int object, const AlembicCompound& top,
                                   const AlembicCompound& geom);
std::vector<int> read_subdivision(AlembicReader& reader, int object, const AlembicCompound& top,
                                  const AlembicCompound& geom);

int read_camera(AlembicReader& reader, int object, const AlembicCompound& top);

/// The material that a path names; a neutral gray one, with a warning, where the archive has none or gives no colour.
int read_material(AlembicReader& reader, int object, const std::string& path);
/// The material of surfaces without one.
int neutral_material(AlembicReader& reader);

/// Index of the object at a path, through instances; -1 where there is none.
int find_object(const AlembicReader& reader, const std::string& path);

/// The first text of a property of the compound; empty where there is none.
std::string read_text(const AlembicReader& reader, const AlembicCompound& compound, std::string_view name);

/// A step or nearest track of a scalar property, each value passed through `convert`.
template <class Convert>
Track<double> read_whole_track(AlembicReader& reader, const AlembicProperty& property, Interpolation interpolation,
                               const Convert& convert) {
    reader.widen(property);
    const AlembicSamples samples = reader.archive.samples(property);
    Track<double> track;
    track.sampling = samples.sampling;
    track.interpolation = interpolation;
    for (const std::uint64_t index : samples.indices) {
        const std::vector<int> values = reader.archive.numbers<int>(property, index);
        track.values.push_back(convert(values.empty() ? 0 : values.front()));
    }
    return track;
}

}  // namespace aleph
