// Keys of nodes that look at something or follow a path.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/errors.h"
#include "engine/pose/parts.h"
#include "engine/scene/transforms.h"
#include "engine/scene/visit.h"
#include "engine/scene_file/aim.h"
#include "engine/scene_file/baked_track.h"
#include "engine/scene_file/guided_nodes.h"
#include "engine/scene_file/reader.h"

namespace aleph {

namespace {

/// Nodes that are placed for all keys of a file, and steps of similar cost: seconds of work.
constexpr std::size_t most_work = 20'000'000;

class GuidedNodesBaker {
  public:
    explicit GuidedNodesBaker(SceneReader& reader)
        : reader_(reader), scene_(reader.scene), guided_(reader.guided), own_nodes_(reader.scene.nodes.size()) {}

    void bake() {
        add_stand_ins();
        frames_ = find_baked_frames(scene_);
        posed_.world.resize(scene_.nodes.size());
        posed_.visible.resize(scene_.nodes.size());
        find_users();
        for (std::size_t i = 0; i < guided_.paths.size(); ++i) bake_path(i);
        for (const int look : order_looks()) bake_look(look);
        scene_.nodes.resize(own_nodes_);
    }

  private:
    /// A node for each point that is looked at, and one with the keys of each path: the range of frames counts them.
    void add_stand_ins() {
        for (const LookAt& look : guided_.looks) {
            Node point;
            point.transform.translation = look.point;
            targets_.push_back(look.target.empty() ? static_cast<int>(scene_.nodes.size())
                                                   : reader_.names.nodes.find(look.target).value_or(no_index));
            if (look.target.empty()) scene_.nodes.push_back(std::move(point));
        }
        for (const FollowPath& path : guided_.paths) {
            Node keys;
            keys.transform.axis_rotation = AxisRotation{.angle = path.at};
            scene_.nodes.push_back(std::move(keys));
        }
    }

    /// Nodes that use each guide: its own and the copies of that.
    void find_users() {
        look_of_.assign(scene_.nodes.size(), no_index);
        std::vector<int> path_of(scene_.nodes.size(), no_index);
        for (std::size_t i = 0; i < guided_.looks.size(); ++i) look_of_[guided_.looks[i].node] = static_cast<int>(i);
        for (std::size_t i = 0; i < guided_.paths.size(); ++i) path_of[guided_.paths[i].node] = static_cast<int>(i);
        for (const auto& [copy, original] : guided_.copies) {
            look_of_[copy] = look_of_[original];
            path_of[copy] = path_of[original];
        }
        users_of_look_.resize(guided_.looks.size());
        users_of_path_.resize(guided_.paths.size());
        for (int node = 0; node < static_cast<int>(own_nodes_); ++node) {
            if (look_of_[node] != no_index) users_of_look_[look_of_[node]].push_back(node);
            if (path_of[node] != no_index) users_of_path_[path_of[node]].push_back(node);
        }
    }

    void work(std::size_t steps, const std::string& place) {
        work_ += steps;
        if (work_ <= most_work) return;
        throw InputError(reader_.file, place,
                         "up to here the keys of \"look_at\" and \"follow_path\" take too long to compute; give "
                         "\"frames\" a shorter range, or these nodes fewer parents");
    }

    auto charge_keys(const std::string& place) {
        return [this, &place](std::size_t bytes) {
            reader_.charge(bytes, place, "give \"frames\" a shorter range, or fewer nodes a \"look_at\" or a path");
        };
    }

    template <class Property>
    void add_key_times(const Property& property, const std::string& place, std::vector<double>& times) {
        const std::size_t count = sample_count(property);
        if (count < 2) return;
        work(count, place);
        charge_keys(place)(count * sizeof(double));
        for (std::size_t i = 0; i < count; ++i) times.push_back(sample_time(property.sampling, i));
    }

    std::vector<double> list_times(std::vector<double> keys, const std::string& place) {
        return list_bake_times(frames_, std::move(keys), [&](std::size_t count) {
            charge_keys(place)(count * sizeof(double));
            work(count, place);
        });
    }

    /// Keys of a rotation that follows an aim.
    /// @param aim_at  of seconds
    Track<glm::dquat> bake_rotation(const std::function<Aim(double)>& aim_at, const std::vector<double>& times,
                                    const std::string& place, const char* fault) {
        std::optional<glm::dquat> first;
        std::optional<Aim> along_up;
        for (const double seconds : times) {
            const Aim aim = aim_at(seconds);
            first = find_rotation(aim);
            if (first) break;
            if (!along_up && aim.direction != glm::dvec3(0.0)) along_up = aim;
        }
        if (!first && !along_up) throw InputError(reader_.file, place, fault);
        const Motion<glm::dquat> motion{
            [&](double seconds, const glm::dquat& near) { return rotation_near(aim_at(seconds), near); },
            baked_rotation_tolerance};
        return bake_track<glm::dquat>(motion, times, first ? *first : rotation_along_up(*along_up), charge_keys(place));
    }

    /// The node's z axis points away from where its -z looks, and its y axis up, but for negative scales.
    Aim with_scale(Aim aim, const Track<glm::dvec3>& scale, double seconds) const {
        const glm::dvec3 factors = evaluate(scale, seconds);
        if (factors.z < 0.0) aim.direction = -aim.direction;
        if (factors.y < 0.0) aim.up = -aim.up;
        return aim;
    }

    void bake_path(std::size_t index) {
        const FollowPath& path = guided_.paths[index];
        const double length = path.curve.length();
        const auto place_at = [&](double seconds) {
            work(16, path.place);  // finds a place on the curve
            const double at = evaluate(path.at, seconds);
            return path.curve.at(length * (path.closed ? at - std::floor(at) : at));
        };
        const Track<glm::dvec3>& scale = scene_.nodes[path.node].transform.scale;
        std::vector<double> keys;
        add_key_times(path.at, path.place, keys);
        if (path.align) add_key_times(scale, path.place, keys);
        const std::vector<double> times = list_times(std::move(keys), path.place);
        const Motion<glm::dvec3> motion{[&](double seconds, const glm::dvec3&) { return place_at(seconds).position; },
                                        baked_path_tolerance * length};
        const auto translation = bake_track<glm::dvec3>(motion, times, glm::dvec3(0.0), charge_keys(path.place));
        for (const glm::dvec3& value : translation.values) {
            if (!(glm::length(value) <= max_json_number))
                throw InputError(reader_.file, path.place, "the node moves too far in too short a time");
        }
        const auto aim_at = [&](double seconds) {
            return with_scale({place_at(seconds).direction, path.up}, scale, seconds);
        };
        std::optional<Track<glm::dquat>> rotation;
        if (path.align) rotation = bake_rotation(aim_at, times, path.place, "the path has no direction there");
        for (const int user : users_of_path_[index]) {
            charge_keys(path.place)(translation.values.size() * 4 * sizeof(double));
            scene_.nodes[user].transform.translation = translation;
            if (rotation) charge_keys(path.place)(rotation->values.size() * 5 * sizeof(double));
            if (rotation) scene_.nodes[user].transform.rotation = *rotation;
        }
    }

    /// Looks in an order in which all that the place and the direction of a node depend on is known before: the turns
    /// of the nodes above it and above its target.
    std::vector<int> order_looks() {
        enum class State : std::uint8_t { untouched, open, done };
        struct Step {
            int look;
            int above;  ///< the node to look at next
            bool target = false;
        };
        const auto parent_of = [&](int node) { return scene_.nodes[node].parent; };
        std::vector<State> states(guided_.looks.size(), State::untouched);
        std::vector<int> order;
        std::vector<Step> steps;
        const auto open = [&](int look) {
            states[look] = State::open;
            steps.push_back({look, parent_of(guided_.looks[look].node)});
        };
        for (int start = 0; start < std::ssize(guided_.looks); ++start) {
            if (states[start] == State::untouched) open(start);
            while (!steps.empty()) {
                Step& step = steps.back();
                if (step.above == no_index && !step.target) {
                    step.target = true;
                    step.above = parent_of(targets_[step.look]);
                } else if (step.above == no_index) {
                    states[step.look] = State::done;
                    order.push_back(step.look);
                    steps.pop_back();
                } else {
                    work(1, guided_.looks[step.look].place);
                    const int other = look_of_[step.above];
                    step.above = parent_of(step.above);
                    if (other == no_index || states[other] == State::done) continue;
                    if (states[other] == State::open) refuse_cycle(step.look, other);
                    open(other);
                }
            }
        }
        return order;
    }

    [[noreturn]] void refuse_cycle(int look, int other) const {
        const LookAt& refused = guided_.looks[look];
        throw InputError(
            reader_.file, refused.place,
            look == other
                ? fmt::format("\"{}\" moves when this node turns, so that it cannot look there",
                              printable(refused.target))
                : fmt::format("a cycle: this node turns \"{}\" or its target, and that turns this node or its target",
                              printable(scene_.nodes[guided_.looks[other].node].name)));
    }

    /// The nodes and all above them, parents first.
    std::vector<int> list_chain(std::initializer_list<int> nodes, const std::string& place) {
        std::vector<int> chain;
        for (int node : nodes) {
            for (; node != no_index; node = scene_.nodes[node].parent) {
                work(1, place);
                chain.push_back(node);
            }
        }
        std::sort(chain.begin(), chain.end());
        chain.erase(std::unique(chain.begin(), chain.end()), chain.end());
        return chain;
    }

    void bake_look(int index) {
        const LookAt& look = guided_.looks[index];
        const int target = targets_[index];
        if (target == look.node) throw InputError(reader_.file, look.place, "a node cannot look at itself");
        const std::vector<int> chain = list_chain({look.node, target}, look.place);
        std::vector<double> keys;
        for (const int node : chain)
            visit_tracks(scene_.nodes[node], [&](const auto& property) { add_key_times(property, look.place, keys); });
        // Without its scale and rotation the node's matrix has its parent's axes.
        Track<glm::dvec3>& own_scale = scene_.nodes[look.node].transform.scale;
        const Track<glm::dvec3> scale = std::exchange(own_scale, Track<glm::dvec3>(glm::dvec3(1.0)));
        const std::vector<double> times = list_times(std::move(keys), look.place);
        const auto place = [&](double seconds) {
            work(chain.size(), look.place);
            for (const int node : chain) place_node(scene_, node, seconds, posed_);
            return std::pair(posed_.world[look.node], glm::dvec3(posed_.world[target][3]));
        };
        double farthest = 0.0;
        for (const double seconds : times) {
            const auto [axes, seen] = place(seconds);
            farthest = std::max({farthest, largest_element(axes[3]), largest_element(seen)});
        }
        // Nearer than this the difference of the two places is rounding.
        const double least_distance = 1e-13 * farthest;
        const auto aim_at = [&](double seconds) {
            const auto [axes, seen] = place(seconds);
            return with_scale(aim_in(axes, seen, look.up, least_distance), scale, seconds);
        };
        const Track<glm::dquat> rotation =
            bake_rotation(aim_at, times, look.place, "the node is always where it looks: move it, or look elsewhere");
        own_scale = scale;
        for (const int user : users_of_look_[index]) {
            charge_keys(look.place)(rotation.values.size() * 5 * sizeof(double));
            scene_.nodes[user].transform.rotation = rotation;
        }
    }

    /// @param axes  a place with the parent's axes. Directions go from the world to them by their inverse, which the
    ///              cofactors give for every size of scale
    static Aim aim_in(const glm::dmat4& axes, const glm::dvec3& target, const glm::dvec3& up, double least_distance) {
        const glm::dvec3 way = target - glm::dvec3(axes[3]);
        if (!(largest_element(way) > least_distance) || !has_full_rank(axes)) return {};
        const glm::dmat3 inverse = glm::transpose(normal_matrix(axes));
        return {safe_normalize(inverse * safe_normalize(way)), safe_normalize(inverse * up)};
    }

    SceneReader& reader_;
    Scene& scene_;
    const GuidedNodes& guided_;
    const std::size_t own_nodes_;
    BakedFrames frames_;
    ScenePose posed_;
    std::vector<int> targets_;  ///< node per look
    std::vector<int> look_of_;  ///< per node, of copies too
    std::vector<std::vector<int>> users_of_look_, users_of_path_;
    std::size_t work_ = 0;
};

}  // namespace

void bake_guided_nodes(SceneReader& reader) {
    if (reader.guided.looks.empty() && reader.guided.paths.empty()) return;
    GuidedNodesBaker(reader).bake();
}

}  // namespace aleph
