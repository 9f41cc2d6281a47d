#include "render/plan/effect_picture.h"

#include "engine/base/index.h"

namespace aleph {

namespace {

Rgb mix(const EffectTable& left_out, const MaterialFacts& material, const FrameFacts& facts) {
    Rgb sum(0.0f);
    float count = 0.0f;
    for (const EffectRow& row : left_out) {
        if (row.shows != nullptr && !row.shows(material, facts)) continue;
        sum += row.color;
        count += 1.0f;
    }
    return count > 0.0f ? sum / count : sum;
}

}  // namespace

Image<Rgb> make_effect_picture(const Image<Hit>& hits, const FrameFacts& facts, const EffectsPlan& plan,
                               std::size_t instances, const EffectTable& table) {
    EffectTable left_out;
    for (const EffectRow& row : table) {
        if (row.color != Rgb(0.0f) && plan.of(row.effect.id).leaves_out()) left_out.push_back(row);
    }
    std::vector<Rgb> colors(instances, Rgb(0.0f));
    for (const ObjectFacts& object : facts.objects) colors[object.instance] = mix(left_out, object.material, facts);
    Image<Rgb> picture(hits.width, hits.height, Rgb(0.0f));
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (hits.pixels[i].instance != no_index) picture.pixels[i] = colors[hits.pixels[i].instance];
    }
    return picture;
}

}  // namespace aleph
