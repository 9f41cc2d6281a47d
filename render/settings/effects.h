#pragma once
// The effects that the renderer knows, by name, and sets of them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace aleph {

enum class Effect : std::uint8_t {
    direct_light,       ///< light straight from lamps and the environment
    area_shadows,       ///< shadows of lights that have an area, the environment included
    indirect_diffuse,   ///< light that Lambert layers pass on, gathered over hemispheres
    more_bounces,       ///< of it, beyond the first
    glossy_reflection,  ///< lobes of a width: gloss, rough coats, sheen
    mirror_reflection,  ///< smooth gloss and coats
    refraction,         ///< light that passes glass, and what glass reflects
    caustics,           ///< light that reaches Lambert layers by way of other layers
    environment,        ///< light from all around the scene
    emission,           ///< surfaces that shine
    textures,           ///< with their filtering
    normal_maps,
    alpha,           ///< masks and blending
    motion_blur,     ///< samples over the time in which the shutter is open
    depth_of_field,  ///< samples over the lens
    subdivision,
    deformation,       ///< skins, morph targets, point caches
    motion,            ///< of each pixel into the next frame
    saliency,          ///< where viewers look
    cache_carry_over,  ///< indirect light from key moments
};

inline constexpr std::size_t effect_count = 20;

/// A set of effects.
class EffectSet {
  public:
    bool contains(Effect effect) const { return (bits_ & bit(effect)) != 0; }
    bool empty() const { return bits_ == 0; }
    void add(Effect effect) { bits_ |= bit(effect); }
    void remove(Effect effect) { bits_ &= ~bit(effect); }
    bool operator==(const EffectSet&) const = default;

  private:
    static std::uint32_t bit(Effect effect) { return std::uint32_t{1} << static_cast<int>(effect); }
    std::uint32_t bits_ = 0;
};

/// "glossy_reflection" and so on, in the order of Effect.
const std::array<std::string, effect_count>& effect_names();

inline const std::string& effect_name(Effect effect) {
    return effect_names()[static_cast<std::size_t>(effect)];
}

/// Names separated by commas; spaces around them do not count. Empty text is the empty set.
/// @param unknown  set to the first name that is not an effect's; empty if all are
EffectSet parse_effects(const std::string& text, std::string& unknown);

/// As parse_effects reads them.
std::string format_effects(const EffectSet& effects);

}  // namespace aleph
