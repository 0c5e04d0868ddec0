// Numbers at random for mutators: the fuzzer gives the seed, so that it can do the same again.
#pragma once

#include <cstddef>
#include <random>

namespace penumbra {

class FuzzRandom {
public:
    explicit FuzzRandom(unsigned seed) : engine_(seed) {}
    /// From 0 to below `count`, which is at least 1.
    std::size_t below(std::size_t count) { return engine_() % count; }
    bool one(std::size_t of) { return below(of) == 0; }
    template <class List>
    const auto& of(const List& list) {
        return list[below(std::size(list))];
    }

private:
    std::mt19937 engine_;
};

} // namespace penumbra
