#include "exchange/pack.hpp"

#include <gtest/gtest.h>

#include <array>

using namespace hemoflux::exchange;

TEST(Pack, LoadStoreGatherSelect) {
    std::array<double, 32> in{}, out{};
    for (std::size_t i = 0; i < in.size(); ++i) in[i] = static_cast<double>(i) - 3.5;
    const Pack a = load<Pack>(in.data() + 1);
    store(out.data(), absolute(a));
    for (std::size_t i = 0; i < pack_lanes; ++i) EXPECT_EQ(out[i], std::fabs(in[i + 1]));

    out.fill(-1);
    store_first(out.data(), a, static_cast<std::ptrdiff_t>(pack_lanes) - 1);
    EXPECT_EQ(out[pack_lanes - 1], -1);
    if (pack_lanes > 1) {
        EXPECT_EQ(out[pack_lanes - 2], in[pack_lanes - 1]);
    }

    std::array<int, 32> index{};
    for (std::size_t i = 0; i < index.size(); ++i) index[i] = static_cast<int>(31 - i);
    const Pack g = gather<Pack>(in.data(), index.data());
    store(out.data(), select(g > a, g, a));
    for (std::size_t i = 0; i < pack_lanes; ++i) EXPECT_EQ(out[i], std::max(in[31 - i], in[i + 1]));
    const Pack t = load_strided<Pack>(in.data(), 3, static_cast<std::ptrdiff_t>(pack_lanes));
    EXPECT_EQ(lane_sum(load_strided<Pack>(in.data(), 3, 1)), static_cast<double>(pack_lanes) * in[0]);
    out.fill(-1);
    store_strided(out.data(), 2, t, static_cast<std::ptrdiff_t>(pack_lanes));
    for (std::size_t i = 0; i < pack_lanes; ++i) {
        EXPECT_EQ(out[2 * i], in[3 * i]);
        EXPECT_EQ(out[2 * i + 1], -1);
    }
    double sum = 0;
    for (std::size_t i = 0; i < pack_lanes; ++i) sum += in[i + 1];
    EXPECT_EQ(lane_sum(a), sum);
}

TEST(Pack, RoundUp) {
    EXPECT_EQ(round_up(0, 8), 0u);
    EXPECT_EQ(round_up(1, 8), 8u);
    EXPECT_EQ(round_up(16, 8), 16u);
}
