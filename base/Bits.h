// The bits of a mask, one after the other.
#pragma once

#include <bit>
#include <concepts>

namespace penumbra {

/// The positions of the bits that are set, from the lowest on: for (int i : bitsOf(mask)).
template <std::unsigned_integral Mask>
class BitsOf {
public:
    class Iterator {
    public:
        explicit Iterator(Mask left) : left_(left) {}
        int operator*() const { return std::countr_zero(left_); }
        Iterator& operator++() {
            left_ &= left_ - 1;
            return *this;
        }
        bool operator!=(const Iterator& other) const { return left_ != other.left_; }

    private:
        Mask left_;
    };

    explicit BitsOf(Mask mask) : mask_(mask) {}
    Iterator begin() const { return Iterator(mask_); }
    Iterator end() const { return Iterator(0); }

private:
    Mask mask_;
};

template <std::unsigned_integral Mask>
BitsOf<Mask> bitsOf(Mask mask) {
    return BitsOf<Mask>(mask);
}

} // namespace penumbra
