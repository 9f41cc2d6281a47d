#pragma once
// Operators that can be changed when a program starts. mutate.py writes `a <ALEPH_SITE(17)< b` for `a < b`; with
// ALEPH_MUTANT=17 in the environment that is `a <= b`. All mutants are then compiled at once. ALEPH_MUTANT_SEEN names a
// file to which a program writes the sites that it reached.

#include <cstdio>
#include <cstdlib>
#include <type_traits>
#include <vector>

namespace mutants {

struct State {
    int active = -1;
    std::vector<char> seen;

    State() {
        if (const char* const id = std::getenv("ALEPH_MUTANT")) active = std::atoi(id);
        if (std::getenv("ALEPH_MUTANT_SEEN") != nullptr) seen.resize(1 << 20);
    }
    ~State() {
        if (seen.empty()) return;
        std::FILE* const file = std::fopen(std::getenv("ALEPH_MUTANT_SEEN"), "a");
        if (file == nullptr) return;
        for (std::size_t i = 0; i < seen.size(); ++i)
            if (seen[i] != 0) std::fprintf(file, "%zu\n", i);
        std::fclose(file);
    }
};
inline State state;

inline bool is_on(int id) {
    if (!state.seen.empty()) state.seen[static_cast<std::size_t>(id)] = 1;
    return state.active == id;
}

template <int Id>
struct Site {};

template <class A, int Id>
struct Bound {
    const A& first;
};

// OPERATOR and what it becomes. An operator that the types do not have leaves the site as it is.
#define ALEPH_MUTANT_OPERATOR(OPERATOR, OTHER)                                                                        \
    template <class A, int Id>                                                                                        \
    constexpr Bound<A, Id> operator OPERATOR(const A& first, Site<Id>) {                                              \
        return {first};                                                                                               \
    }                                                                                                                 \
    template <class A, int Id, class B>                                                                               \
    constexpr auto operator OPERATOR(const Bound<A, Id>& bound, const B& second) {                                    \
        if constexpr (requires {                                                                                      \
                          static_cast<std::decay_t<decltype(bound.first OPERATOR second)>>(bound.first OTHER second); \
                      }) {                                                                                            \
            if (!std::is_constant_evaluated() && is_on(Id))                                                           \
                return static_cast<std::decay_t<decltype(bound.first OPERATOR second)>>(bound.first OTHER second);    \
        }                                                                                                             \
        return bound.first OPERATOR second;                                                                           \
    }
ALEPH_MUTANT_OPERATOR(<, <=)
ALEPH_MUTANT_OPERATOR(<=, <)
ALEPH_MUTANT_OPERATOR(>, >=)
ALEPH_MUTANT_OPERATOR(>=, >)
ALEPH_MUTANT_OPERATOR(==, !=)
ALEPH_MUTANT_OPERATOR(!=, ==)
ALEPH_MUTANT_OPERATOR(+, -)
ALEPH_MUTANT_OPERATOR(-, +)
ALEPH_MUTANT_OPERATOR(*, /)
ALEPH_MUTANT_OPERATOR(/, *)
#undef ALEPH_MUTANT_OPERATOR

}  // namespace mutants

#define ALEPH_SITE(ID) \
    ::mutants::Site<ID> {}
