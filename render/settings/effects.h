#pragma once
// The effects that the renderer knows, by name, and sets of them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace aleph {

/// effect_list describes them.
enum class Effect : std::uint8_t {
    direct_light,
    area_shadows,
    indirect_diffuse,
    more_bounces,
    glossy_reflection,
    mirror_reflection,
    refraction,
    caustics,
    environment,
    emission,
    textures,
    normal_maps,
    alpha,
    motion_blur,
    depth_of_field,
    subdivision,
    deformation,
    motion,
    saliency,
    cache_carry_over,
};

/// An effect as users know it.
struct EffectName {
    Effect id;
    const char* name;
    const char* description;
};

/// All effects, in the order of Effect.
inline constexpr auto effect_list = std::to_array<EffectName>({
    {Effect::direct_light, "direct_light", "light straight from lamps and the environment"},
    {Effect::area_shadows, "area_shadows", "shadows of lights that have an area, the environment included"},
    {Effect::indirect_diffuse, "indirect_diffuse", "light that Lambert layers pass on, gathered over hemispheres"},
    {Effect::more_bounces, "more_bounces", "indirect light beyond the first bounce"},
    {Effect::glossy_reflection, "glossy_reflection", "lobes that have a width: gloss, rough coats, sheen"},
    {Effect::mirror_reflection, "mirror_reflection", "smooth gloss and coats"},
    {Effect::refraction, "refraction", "light that passes glass, and what glass reflects"},
    {Effect::caustics, "caustics", "light that reaches Lambert layers by way of other layers"},
    {Effect::environment, "environment", "light from all around the scene"},
    {Effect::emission, "emission", "surfaces that shine"},
    {Effect::textures, "textures", "textures, with their filtering"},
    {Effect::normal_maps, "normal_maps", "normals from textures"},
    {Effect::alpha, "alpha", "masks and blending"},
    {Effect::motion_blur, "motion_blur", "samples over the time in which the shutter is open"},
    {Effect::depth_of_field, "depth_of_field", "samples over the lens"},
    {Effect::subdivision, "subdivision", "smooth surfaces of subdivision cages"},
    {Effect::deformation, "deformation", "skins, morph targets, point caches"},
    {Effect::motion, "motion", "motion of each pixel into the next frame"},
    {Effect::saliency, "saliency", "where viewers look"},
    {Effect::cache_carry_over, "cache_carry_over", "indirect light from lighting keyframes"},
});

inline constexpr std::size_t effect_count = effect_list.size();

constexpr const EffectName& describe(Effect effect) {
    return effect_list[static_cast<std::size_t>(effect)];
}

class EffectSet {
  public:
    EffectSet() = default;
    explicit EffectSet(Effect effect) : bits_(bit(effect)) {}
    bool contains(Effect effect) const { return (bits_ & bit(effect)) != 0; }
    bool empty() const { return bits_ == 0; }
    void add(Effect effect) { bits_ |= bit(effect); }
    void add(EffectSet others) { bits_ |= others.bits_; }
    void remove(Effect effect) { bits_ &= ~bit(effect); }
    bool operator==(const EffectSet&) const = default;

  private:
    static std::uint32_t bit(Effect effect) { return std::uint32_t{1} << static_cast<int>(effect); }
    std::uint32_t bits_ = 0;
};

/// Reads names separated by commas; spaces around them do not count. Empty text is the empty set.
/// @param unknown  set to the first name that is not an effect's; empty if all are
EffectSet parse_effects(const std::string& text, std::string& unknown);

/// Names as parse_effects reads them.
std::string format_effects(const EffectSet& effects);

}  // namespace aleph
