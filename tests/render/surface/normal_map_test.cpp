// Shading normals that disagree with the surface: normal maps, bad vertex normals, narrow triangles.

#include "render/light/light_choice.h"
#include "tests/support/lobes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// Normals along the surface or, the last, into it.
const std::vector<glm::u8vec4> strong_texels{{255, 128, 128, 255}, {0, 128, 128, 255},  {128, 255, 128, 255},
                                             {128, 0, 128, 255},   {230, 60, 140, 255}, {128, 128, 0, 255}};

struct Kind {
    const char* name;
    Material material;
};

std::vector<Kind> list_kinds() {
    Material lambert, metal, mirror, plastic, coated, cloth;
    lambert.gloss.metallic = lambert.gloss.specular = 0.0;
    metal.gloss.roughness = 0.4;
    mirror.gloss.roughness = 0.0;
    plastic.gloss.metallic = 0.0;
    plastic.gloss.roughness = 0.6;
    coated = plastic;
    coated.layers.clearcoat = 1.0;
    coated.layers.clearcoat_roughness = 0.3;
    cloth = lambert;
    cloth.layers.sheen_color = glm::dvec3(1.0);
    cloth.layers.sheen_roughness = 0.5;
    return {{"Lambert", lambert}, {"metal", metal},   {"mirror", mirror},
            {"plastic", plastic}, {"coated", coated}, {"cloth", cloth}};
}

/// A quad that faces +z, with the texel as the normal map of its surface and of its coat; a lamp is behind it.
Scene make_mapped_quad(Material material, const glm::u8vec4& texel) {
    Scene scene;
    SceneImage image{.bytes = Image<glm::u8vec4>(1, 1, texel)};
    scene.images.push_back(image);
    material.textures[TextureSlot::normal].image = material.textures[TextureSlot::clearcoat_normal].image = 0;
    scene.materials.push_back(std::move(material));
    add_mesh(scene, make_quad(4.0, 4.0, 0));
    add_light(scene, Light::Kind::point, glm::dvec3(100.0), {0.3, -0.2, -1.0});
    return scene;
}

ViewedSurface look_at_origin(const Stage& stage, const glm::vec3& view) {
    Tracer tracer(stage.rays);
    const glm::vec3 origin = view * 2.0f + glm::vec3(0.11f, 0.07f, 0.0f) - glm::vec3(stage.shading.anchor);
    const Hit hit = tracer.intersect({origin, -view});
    EXPECT_NE(hit.instance, no_index);
    return view_surface(stage.shading, make_surface_point(stage.shading, hit, -view), view, {});
}

/// Some light is scattered, not more than arrives, and none to behind the surface.
void expect_no_gain(const LitSurface& lit, std::uint32_t seed, const char* name) {
    const auto check = [](const ScatterSample& sample) { EXPECT_GT(sample.direction.z, 0.0f); };
    EXPECT_TRUE(holds([&](Trial& trial) {
        const Mean mean = mean_scattered(lit, trial.times(500), seed + trial.seed, LobeSet::all, check);
        trial.at_most(mean, 1.001);
        EXPECT_GT(mean.mean(), 0.1) << "black";
    })) << name
        << ", cosine " << lit.cos_view;
}

/// Light from straight above on normals that lean 30 degrees to both sides, about seven texels to a pixel. Their mean
/// stands upright: with it alone the surface would be 15 % brighter.
TEST(NormalMap, FinerThanAPixelItIsAsBrightAsItsNormalsAre) {
    const auto make_scene = [](double scale) {
        Scene scene = make_mapped_quad(list_kinds()[0].material, {});
        scene.images[0].bytes = Image<glm::u8vec4>(2, 1);
        scene.images[0].bytes.pixels = {{191, 128, 238, 255}, {64, 128, 238, 255}};
        TextureRef& map = scene.materials[0].textures[TextureSlot::normal];
        map.nearest = true;
        map.uv_scale = {scale, 1.0};
        scene.environment.radiance.reset();
        scene.lights.clear();
        scene.nodes.pop_back();
        add_light(scene, Light::Kind::directional, glm::dvec3(100.0), glm::dvec3(0.0));
        add_camera(scene, {0.0, 0.0, 2.0}, glm::dvec3(0.0), 0.8);
        return scene;
    };
    const double upright = 100.0 / pi, leaning = upright * std::cos(glm::radians(30.0));
    // One ray for a pixel takes the mean, which does not flicker.
    for (const auto& [scale, spp, expected] :
         {std::tuple{1.0, 4, leaning}, std::tuple{96.0, 4, leaning}, std::tuple{96.0, 1, upright}}) {
        RenderSettings settings = plain_settings(0.0, 1);
        settings.sampling.spp = spp;
        const Image<Rgb> picture = shade(Stage(make_scene(scale), 16, 12), settings).color;
        double sum = 0.0;
        for (const Rgb& pixel : picture.pixels) sum += pixel.x;
        EXPECT_NEAR(sum / static_cast<double>(picture.size()), expected, 0.005 * expected) << scale << ' ' << spp;
    }
}

TEST(NormalMap, MC26_NoLightFromBehindAndNoGain) {
    for (const Kind& kind : list_kinds()) {
        for (const glm::u8vec4& texel : strong_texels) {
            const Stage stage(make_mapped_quad(kind.material, texel));
            for (const float cosine : {1.0f, 0.5f, 0.1f, 0.02f}) {
                for (const float azimuth : {0.3f, 2.0f, 4.0f}) {
                    const ViewedSurface surface = look_at_origin(stage, direction_of(cosine, azimuth));
                    const LitSurface lit(surface);
                    ASSERT_GT(lit.cos_view, 0.0f) << kind.name;
                    RandomStream random({1, 0, 0, 0});
                    const LobeShares shares = share_lobes(lit, LobeSet::all);
                    for (int i = 0; i < 8; ++i) {
                        const LightNumbers numbers{random.next(), random.next_2d()};
                        ASSERT_EQ(choose_light(stage.lighting(), lit, shares, numbers).radiance, Rgb(0.0f))
                            << kind.name;
                    }
                    expect_no_gain(lit, 2, kind.name);
                }
            }
        }
    }
}

TEST(NormalMap, MC26_KeepVisibleKeepsViewerAndMirrorDirectionAbove) {
    std::mt19937 engine(3);
    std::uniform_real_distribution<float> height(-1.0f, 1.0f), facing(0.005f, 1.0f), azimuth(0.0f, 6.28f);
    const glm::vec3 outwards(0.0f, 0.0f, 1.0f);
    int kept = 0, bent = 0;
    for (int i = 0; i < 20'000; ++i) {
        const glm::vec3 normal = direction_of(height(engine), azimuth(engine));
        const glm::vec3 view = direction_of(facing(engine), azimuth(engine));
        const glm::vec3 n = keep_visible(normal, outwards, outwards, view);
        ASSERT_NEAR(glm::length(n), 1.0f, 1e-5f);
        ASSERT_GT(glm::dot(n, view), 0.0f);
        ASSERT_GT((2.0f * glm::dot(n, view) * n - view).z, 0.0f);
        const bool good = glm::dot(normal, view) > 0.01f && (2.0f * glm::dot(normal, view) * normal - view).z > 0.01f;
        if (good) {
            ASSERT_EQ(n, normal);
            ++kept;
        } else if (n != normal) {
            ++bent;
            ASSERT_NEAR(glm::dot(glm::cross(normal, outwards), n), 0.0f, 1e-5f) << "between the two";
        }
    }
    EXPECT_GT(kept, 2000);
    EXPECT_GT(bent, 2000);
}

TEST(NormalMap, RC11_BadVertexNormalsFallBackToTheSurface) {
    const std::vector<glm::vec3> bad{{0.0f, 0.0f, 0.0f},   {float_nan, 0.0f, 1.0f}, {0.0f, float_infinity, 1.0f},
                                     {0.0f, 0.0f, -1.0f},  {1.0f, 0.0f, -0.2f},     {0.99f, 0.0f, 0.1f},
                                     {-0.7f, 0.7f, 0.05f}, {1e-30f, 0.0f, 1e-30f}};
    for (const Kind& kind : list_kinds()) {
        for (const glm::vec3& normal : bad) {
            Scene scene;
            scene.materials.push_back(kind.material);
            Mesh quad = make_quad(4.0, 4.0, 0);
            quad.normals.assign(quad.positions.size(), normal);
            add_mesh(scene, std::move(quad));
            const Stage stage(std::move(scene));
            for (const float cosine : {1.0f, 0.3f, 0.05f}) {
                for (const float azimuth : {0.0f, 1.5f, 3.14f}) {
                    const ViewedSurface surface = look_at_origin(stage, direction_of(cosine, azimuth));
                    ASSERT_NEAR(glm::length(surface.point.normal), 1.0f, 1e-5f) << kind.name;
                    ASSERT_GT(surface.point.normal.z, 0.0f);
                    expect_no_gain(LitSurface(surface), 4, kind.name);
                }
            }
        }
    }
}

/// glTF 2.0, 3.7.3.3: the transform of a skinned mesh's own node is ignored. Where joints mirror, the outside stays
/// outside, as where nodes of rigid meshes do.
TEST(SkinnedNormals, MirrorsLeaveTheOutsideOutside) {
    const glm::dvec3 plain(1.0), mirror(-1.0, 1.0, 1.0);
    for (const glm::dvec3& own : {plain, mirror}) {
        for (const glm::dvec3& joint : {plain, mirror}) {
            Scene scene;
            add_lambert(scene, glm::dvec3(0.5), glm::dvec3(1.0));
            Mesh ball = make_shape_mesh({.kind = Shape::Kind::sphere, .radius = 1.0, .segments = 16}, 0);
            ball.deformation.skin = 0;
            ball.deformation.joints_per_vertex = 1;
            ball.deformation.joint_weights.assign(ball.positions.size(), {0, 1.0f});
            scene.nodes[static_cast<std::size_t>(add_mesh(scene, std::move(ball)))].transform.scale = own;
            scene.skins.push_back({"", {add_node(scene, glm::dvec3(0.0), no_turn)}, {glm::dmat4(1.0)}});
            scene.nodes.back().transform.scale = joint;
            const Stage stage(std::move(scene));
            Tracer tracer(stage.rays);
            const glm::vec3 anchor(stage.shading.anchor), view(0.0f, 0.0f, 1.0f);
            const Hit hit = tracer.intersect({glm::vec3(0.37f, 0.21f, 3.0f) - anchor, -view});
            ASSERT_NE(hit.instance, no_index);
            const SurfacePoint point = make_surface_point(stage.shading, hit, -view);
            EXPECT_TRUE(point.front);
            EXPECT_GT(glm::dot(point.normal, glm::normalize(point.position + anchor)), 0.9999f) << "not smooth";
            const Emitter::Triangle lamp = stage.lights.emitters[0].triangle(0);
            EXPECT_GT(glm::dot(lamp.normal, lamp.corner + anchor), 0.9f);
        }
    }
}

/// Solves edges = tangent u + bitangent v, exactly enough.
glm::vec3 exact_tangent(const SurfacePoint& point) {
    using Long = long double;
    const glm::vec<2, Long> d1(point.uv_edges[0][0]), d2(point.uv_edges[0][1]);
    const glm::vec<3, Long> e1(point.edges[0]), e2(point.edges[1]);
    const glm::vec<3, Long> t = (e1 * d2.y - e2 * d1.y) / (d1.x * d2.y - d1.y * d2.x);
    return glm::vec3(t / glm::length(t));
}

TEST(NormalMap, MC18_TangentsOfNarrowTriangles) {
    std::mt19937 engine(5);
    std::uniform_real_distribution<float> unit(0.1f, 1.0f), wide(1.0f, 2.0f);
    std::uniform_int_distribution<int> ulps(-8, 8);
    MaterialStage square({.layers = {.anisotropy = 1.0}});
    SurfacePoint& point = square.point;
    int narrow = 0;
    for (int i = 0; i < 5000; ++i) {
        // Two edges that are almost parallel, in space and in the texture: all products nearly cancel.
        const float scale = wide(engine);
        const auto nudge = [&](float x) { return scale * x + static_cast<float>(ulps(engine)) * 1.2e-7f; };
        glm::vec2& d1 = point.uv_edges[0][0];
        glm::vec2& d2 = point.uv_edges[0][1];
        d1 = {unit(engine), unit(engine)};
        d2 = {nudge(d1.x), nudge(d1.y)};
        point.edges[0] = {unit(engine), unit(engine), 0.0f};
        point.edges[1] = {nudge(point.edges[0].x), nudge(point.edges[0].y), 0.0f};
        const SurfaceMaterial surface = square.evaluate();
        if (static_cast<double>(d1.x) * d2.y == static_cast<double>(d1.y) * d2.x) {
            EXPECT_EQ(surface.gloss.stretch, 0.0f) << "no area";
            continue;
        }
        ++narrow;
        ASSERT_NEAR(glm::distance(surface.gloss.tangent, exact_tangent(point)), 0.0f, 1e-6f) << i;
    }
    EXPECT_GT(narrow, 4000);
}

/// KHR_materials_anisotropy: directions are in the tangent space, which is that of the normal map.
TEST(NormalMap, AnisotropyTakesItsTangents) {
    const SceneImage along_x{.bytes = Image<glm::u8vec4>(1, 1, {255, 128, 255, 255})},
        upright{.bytes = Image<glm::u8vec4>(1, 1, {128, 128, 255, 255})};
    for (const bool mapped : {false, true}) {
        for (const bool textured : {false, true}) {
            Material material{.layers = {.anisotropy = 0.6}};
            if (textured) material.textures[TextureSlot::anisotropy] = {.image = 0};
            if (mapped) material.textures[TextureSlot::normal] = {.image = 1, .uv_set = 1};
            MaterialStage square(material, {along_x, upright});
            square.point.edges[0] = {1.0f, 0.0f, 0.0f};
            square.point.edges[1] = up;
            square.point.uv_edges[0][0] = square.point.uv_edges[1][1] = {1.0f, 0.0f};
            square.point.uv_edges[0][1] = square.point.uv_edges[1][0] = {0.0f, -1.0f};
            EXPECT_NEAR(square.evaluate().gloss.tangent.x, mapped ? 0.0f : 1.0f, 0.01f) << mapped << textured;
            EXPECT_NEAR(square.evaluate().gloss.tangent.y, mapped ? 1.0f : 0.0f, 0.01f) << mapped << textured;
        }
    }
}

}  // namespace
}  // namespace aleph
