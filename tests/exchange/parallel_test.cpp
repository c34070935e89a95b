#include "exchange/parallel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

using namespace hemoflux::exchange;

namespace {

struct Square {
    double* out;
    HEMOFLUX_FN void operator()(std::size_t i) const {
        out[i] += static_cast<double>(i) * static_cast<double>(i);
    }
};
struct Inverse {
    HEMOFLUX_FN double operator()(std::size_t i) const { return 1.0 / static_cast<double>(i + 1); }
};
struct SegmentValue {
    HEMOFLUX_FN double operator()(std::size_t s, std::size_t i) const {
        return static_cast<double>(s * 1000 + i);
    }
};
struct Height {
    const double* value;
    HEMOFLUX_FN Maximum operator()(std::size_t i) const { return {value[i]}; }
};
struct AtLeast {
    std::size_t limit;
    HEMOFLUX_FN bool operator()(std::size_t i) const { return i >= limit; }
};

}  // namespace

// Every primitive with no item, one item, fewer items than threads, and many.
class Sizes : public ::testing::TestWithParam<std::size_t> {
  protected:
    void SetUp() override { set_threads(4); }
    void TearDown() override { set_threads(0); }
};
INSTANTIATE_TEST_SUITE_P(All, Sizes, ::testing::Values(0u, 1u, 3u, 511u, 512u, 513u, 10000u));

TEST_P(Sizes, EachIndexIsVisitedOnce) {
    for (const Cost cost : {Cost::cheap, Cost::heavy}) {
        Buffer<double> out(GetParam());
        for_each_index(GetParam(), Square{out.data()}, cost);
        const auto host = out.to_host();
        for (std::size_t i = 0; i < host.size(); ++i) EXPECT_EQ(host[i], static_cast<double>(i * i));
    }
}

TEST_P(Sizes, SumIsBitwiseTheSameForAnyNumberOfThreads) {
    Reduction<double> reduction;
    const double four = reduction.sum(GetParam(), Inverse{});
    set_threads(1);
    const double one = reduction.sum(GetParam(), Inverse{});
    EXPECT_EQ(one, four);
    double expected = 0;
    for (std::size_t i = 0; i < GetParam(); ++i) expected += 1.0 / static_cast<double>(i + 1);
    EXPECT_NEAR(one, expected, 1e-12 * (1 + expected));
}

TEST_P(Sizes, SegmentsAreSummedApart) {
    const std::size_t n = GetParam();
    Reduction<double> reduction;
    Buffer<double> out(3);
    reduction.sum_segments(3, n, SegmentValue{}, out.data());
    const auto host = out.to_host();
    const double base = n ? static_cast<double>(n) * static_cast<double>(n - 1) / 2 : 0;
    for (std::size_t s = 0; s < 3; ++s) EXPECT_EQ(host[s], base + static_cast<double>(s * 1000 * n));
}

TEST_P(Sizes, FindFirst) {
    const std::size_t n = GetParam();
    EXPECT_EQ(find_first(n, AtLeast{n}), n);
    if (n > 0) {
        EXPECT_EQ(find_first(n, AtLeast{n / 2}), n / 2);
    }
}

TEST_P(Sizes, ScanAndSort) {
    const std::size_t n = GetParam();
    std::vector<int> ones(n, 1), keys(n), values(n);
    for (std::size_t i = 0; i < n; ++i)
        keys[i] = static_cast<int>((n - i) / 2), values[i] = static_cast<int>(i);
    Buffer<int> scan(ones), k(keys), v(values);
    exclusive_scan(n, scan.data(), scan.data());
    stable_sort_by_key(n, k.data(), v.data());
    const auto s = scan.to_host(), kh = k.to_host(), vh = v.to_host();
    for (std::size_t i = 0; i < n; ++i) {
        EXPECT_EQ(s[i], static_cast<int>(i));
        EXPECT_EQ(kh[i], keys[static_cast<std::size_t>(vh[i])]);
        if (i > 0) {
            EXPECT_TRUE(kh[i - 1] < kh[i] || (kh[i - 1] == kh[i] && vh[i - 1] < vh[i]));
        }
    }
}

TEST(Maximum, NanIsNeverHidden) {
    Reduction<Maximum> reduction;
    std::vector<double> values(2000, -3.0);
    values[777] = 5.0;
    Buffer<double> v(values);
    EXPECT_EQ(reduction.sum(v.size(), Height{v.data()}).value, 5.0);
    values[3] = std::numeric_limits<double>::quiet_NaN();
    v.assign(values);
    EXPECT_TRUE(std::isnan(reduction.sum(v.size(), Height{v.data()}).value));
}
