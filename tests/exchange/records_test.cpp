#include "exchange/records.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace hemoflux::exchange {

TEST(Records, LoadTransposesAnyChoiceOfRecords) {
    std::vector<double> records(16 * 40);
    for (std::size_t i = 0; i < records.size(); ++i) records[i] = static_cast<double>(i);
    std::vector<std::uint32_t> index;
    for (std::uint32_t l = 0; l < lanes<Pack>; ++l) index.push_back((7 * l + 3) % 40);
    Pack out[16];
    load_records(records.data(), index.data(), out);
    for (std::size_t c = 0; c < 16; ++c) {
        double values[lanes<Pack>];
        store(values, out[c]);
        for (std::size_t l = 0; l < lanes<Pack>; ++l)
            EXPECT_EQ(values[l], records[16 * index[l] + c]) << c << " " << l;
    }
    double one[16];
    load_records(records.data(), index.data(), one);
    for (std::size_t c = 0; c < 16; ++c) EXPECT_EQ(one[c], records[16 * index[0] + c]);
}

TEST(Records, FoursAreStoredOneAfterTheOther) {
    Pack value[4];
    double lane[4][lanes<Pack>], out[4 * lanes<Pack> + 1];
    out[4 * lanes<Pack>] = -1;
    for (std::size_t c = 0; c < 4; ++c) {
        for (std::size_t l = 0; l < lanes<Pack>; ++l) lane[c][l] = static_cast<double>(10 * l + c);
        value[c] = load<Pack>(lane[c]);
    }
    store_fours(out, value);
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t l = 0; l < lanes<Pack>; ++l) EXPECT_EQ(out[4 * l + c], lane[c][l]) << c << " " << l;
    EXPECT_EQ(out[4 * lanes<Pack>], -1);
}

TEST(Records, FourKeepsItsOrder) {
    const double p[4] = {1, 2, 3, 4};
    double r[4];
    store_four(r, 2.0 * load_four(p) - load_four(p));
    for (int c = 0; c < 4; ++c) EXPECT_EQ(r[c], p[c]);
}

}  // namespace hemoflux::exchange
