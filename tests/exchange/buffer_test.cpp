#include "exchange/buffer.hpp"

#include <gtest/gtest.h>

#include <cstdint>

using hemoflux::exchange::Buffer;

TEST(Buffer, StartsWithZeroAndRoundTrips) {
    Buffer<double> b(5);
    EXPECT_EQ(b.to_host(), std::vector<double>(5, 0.0));
    b.assign({1, 2, 3, 4, 5});
    Buffer<double> moved = std::move(b);
    EXPECT_EQ(moved.to_host(), (std::vector<double>{1, 2, 3, 4, 5}));
    moved.fill(7);
    EXPECT_EQ(moved.to_host(), std::vector<double>(5, 7.0));
    EXPECT_THROW(moved.assign({1.0}), std::length_error);
}

TEST(Buffer, IsAlignedAndMayBeEmpty) {
    const Buffer<int> empty(0), some(3);
    EXPECT_EQ(empty.to_host().size(), 0u);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(some.data()) % 64, 0u);
}
