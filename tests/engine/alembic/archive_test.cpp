// Properties of objects, all samples that the truth lists, metadata, times and look-up by time.
#include "engine/alembic/archive.h"
#include "tests/support/files/alembic_truth.h"
#include "tests/support/read_bytes.h"

namespace aleph {
namespace {

AlembicArchive open(const std::string& name) {
    return {read_numbers(archive_path(name)), archive_path(name).string()};
}

int find_object(const AlembicArchive& archive, const std::string& path) {
    for (std::size_t i = 0; i < archive.objects().size(); ++i)
        if (archive.path(static_cast<int>(i)) == path) return static_cast<int>(i);
    return -1;
}

AlembicMetadata metadata_of(const json& truth) {
    AlembicMetadata metadata;
    for (const auto& [key, value] : truth.items()) metadata[key] = value;
    return metadata;
}

constexpr std::array type_names{"bool_t",   "uint8_t", "int8_t",    "uint16_t",  "int16_t",   "uint32_t", "int32_t",
                                "uint64_t", "int64_t", "float16_t", "float32_t", "float64_t", "string",   "wstring"};

void expect_values(const AlembicArchive& archive, const AlembicProperty& property, std::uint64_t index,
                   const json& truth, const std::string& where) {
    const std::string text = where + fmt::format(" sample {}", index);
    if (property.type == PlainType::wide_text) return;  // not read
    if (property.type == PlainType::text) {
        EXPECT_EQ(archive.texts(property, index), truth.get<std::vector<std::string>>()) << text;
    } else if (property.type == PlainType::f16 || property.type == PlainType::f32) {  // printed as single precision
        EXPECT_EQ(archive.numbers<float>(property, index), truth.get<std::vector<float>>()) << text;
    } else if (property.type == PlainType::boolean) {
        EXPECT_EQ(archive.numbers<int>(property, index), truth.get<std::vector<int>>()) << text;
    } else {
        EXPECT_EQ(archive.numbers<double>(property, index), truth.get<std::vector<double>>()) << text;
    }
}

int expect_properties(const AlembicArchive& archive, const AlembicCompound& compound, const json& truth,
                      const std::string& where) {
    int samples = 0;
    EXPECT_EQ(compound.properties.size(), truth.size()) << where;
    for (const json& entry : truth) {
        const std::string name = entry["name"], kind = entry["kind"], here = where + " " + name;
        const AlembicProperty* property = compound.find(name);
        if (property == nullptr) {
            ADD_FAILURE() << here << " is missing";
            continue;
        }
        EXPECT_EQ(property->metadata, metadata_of(entry["metadata"])) << here;
        if (kind == "compound") {
            EXPECT_EQ(property->kind, AlembicProperty::Kind::compound) << here;
            samples += expect_properties(archive, archive.properties(*property), entry["properties"], here);
            continue;
        }
        const bool array = kind == "array";
        EXPECT_EQ(property->kind, array ? AlembicProperty::Kind::array : AlembicProperty::Kind::scalar) << here;
        EXPECT_EQ(type_names[static_cast<std::size_t>(property->type)], entry["pod"]) << here;
        EXPECT_EQ(property->extent, entry["extent"]) << here;
        EXPECT_EQ(property->time_sampling, entry["time_sampling"]) << here;
        EXPECT_EQ(property->sample_count, entry["num_samples"]) << here;
        EXPECT_EQ(property->is_constant(), entry["is_constant"].get<bool>()) << here;
        for (const json& sample : entry["samples"]) {
            const json sizes = array ? sample[1] : json{1};
            EXPECT_EQ(archive.dimensions(*property, sample[0]), sizes.get<std::vector<std::uint64_t>>()) << here;
            expect_values(archive, *property, sample[0], sample.back(), here);
            ++samples;
        }
    }
    return samples;
}

TEST_P(AlembicTruth, EveryPropertyOfEveryObject) {
    const AlembicArchive archive = open(GetParam());
    EXPECT_EQ(archive.metadata(), metadata_of(truth["archive"]["metadata"]));
    int samples = 0;
    std::size_t objects = 0;
    for (const json& entry : truth["objects"]) {
        if (entry.contains("inside_instance")) continue;  // the archive has the source once
        const std::string path = entry["path"];
        const int object = find_object(archive, path);
        ASSERT_GE(object, 0) << path;
        ++objects;
        if (path != "/") {
            const AlembicObject& found = archive.objects()[object];
            EXPECT_EQ(found.metadata, metadata_of(entry["metadata"])) << path;
            EXPECT_EQ(found.schema(), entry["schema"]) << path;
        }
        samples += expect_properties(archive, archive.properties(object), entry["properties"], path);
    }
    for (const AlembicObject& object : archive.objects()) objects += object.is_instance();
    EXPECT_EQ(archive.objects().size(), objects);
    EXPECT_GE(samples, GetParam() == "property_zoo" ? 150 : 10);
}

TEST_P(AlembicTruth, TimesOfSamples) {
    const AlembicArchive archive = open(GetParam());
    const json& samplings = truth["archive"]["time_samplings"];
    ASSERT_EQ(archive.time_samplings().size(), samplings.size());
    for (std::size_t i = 0; i < samplings.size(); ++i) {
        const TimeSampling& sampling = archive.time_samplings()[i];
        const std::string kind = samplings[i]["type"];
        EXPECT_EQ(sampling.kind, kind == "uniform"  ? TimeSampling::Kind::uniform
                                 : kind == "cyclic" ? TimeSampling::Kind::cyclic
                                                    : TimeSampling::Kind::acyclic);
        EXPECT_EQ(archive.sample_maxima()[i], samplings[i]["max_num_samples"]);
        const json& times = samplings[i]["first_sample_times"];
        for (std::size_t k = 0; k < times.size(); ++k) EXPECT_EQ(sample_time(sampling, k), times[k]) << i << " " << k;
    }
}

INSTANTIATE_TEST_SUITE_P(All, AlembicTruth, testing::ValuesIn(all_archives()),
                         [](const auto& archive) { return archive.param; });

TEST(AlembicLookUp, ASampleWithinTheToleranceCountsAsReached) {
    TimeSampling times;
    times.kind = TimeSampling::Kind::acyclic;
    times.times = {0.0, 1.0, 2.0};
    EXPECT_EQ(alembic_floor(times, 3, -5.0), 0u);
    EXPECT_EQ(alembic_floor(times, 3, 1.0 - 0.9e-5), 1u);
    EXPECT_EQ(alembic_floor(times, 3, 1.0 - 1.1e-5), 0u);
    EXPECT_EQ(alembic_floor(times, 3, 9.0), 2u);
    EXPECT_EQ(alembic_floor(times, 2, 9.0), 1u);  // fewer samples than times
}

TEST(AlembicSamples, RepeatsAtBothEndsAreLeftOut) {
    const AlembicArchive archive = open("property_zoo");
    const AlembicCompound zoo = archive.properties(find_object(archive, "/zoo"));
    const auto indices = [&](const char* name) { return archive.samples(*zoo.find(name)).indices; };
    using Indices = std::vector<std::uint64_t>;
    EXPECT_EQ(indices("p_one"), (Indices{0}));
    EXPECT_EQ(indices("p_const"), (Indices{0}));
    EXPECT_EQ(indices("p_all"), (Indices{0, 1, 2, 3}));
    EXPECT_EQ(indices("p_lead"), (Indices{2, 3, 4, 5}));
    EXPECT_EQ(indices("p_trail"), (Indices{0, 1, 2, 3}));
    EXPECT_EQ(indices("p_both"), (Indices{2, 3, 4, 5, 6}));
    EXPECT_EQ(indices("p_aaab"), (Indices{2, 3}));
    const AlembicProperty& lead = *zoo.find("p_lead");
    const AlembicSamples samples = archive.samples(lead);
    for (std::size_t i = 0; i < samples.indices.size(); ++i)
        EXPECT_NEAR(samples.time(i), sample_time(archive.time_samplings()[1], samples.indices[i]), 1e-15);
}

TEST(AlembicSamples, SharedDataIsOneBlock) {
    const AlembicArchive archive = open("property_zoo");
    const AlembicCompound zoo = archive.properties(find_object(archive, "/zoo"));
    EXPECT_EQ(archive.storage(*zoo.find("rank2"), 0), archive.storage(*zoo.find("sharesRank2"), 0));
    EXPECT_EQ(archive.storage(*zoo.find("p_mid"), 1), archive.storage(*zoo.find("p_mid"), 3));
    EXPECT_NE(archive.storage(*zoo.find("p_mid"), 0), archive.storage(*zoo.find("p_mid"), 3));
}

}  // namespace
}  // namespace aleph
