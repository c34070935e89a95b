#include "fluid/compact_pattern.hpp"

#include <algorithm>
#include <numeric>
#include <set>

namespace hemoflux::fluid {
namespace {

/// Neighbours of every cell, each once, ascending.
std::vector<std::vector<std::uint32_t>> neighbours(std::size_t cells, const std::vector<CompactFace>& faces) {
    std::vector<std::vector<std::uint32_t>> list(cells);
    for (const CompactFace& f : faces)
        if (!f.border) {
            list[f.left].push_back(f.right);
            list[f.right].push_back(f.left);
        }
    for (auto& l : list) {
        std::sort(l.begin(), l.end());
        l.erase(std::unique(l.begin(), l.end()), l.end());
    }
    return list;
}

/// Adds the blocks that arise when rows are eliminated in ascending order, up to the level `fill`. A symmetric pattern stays
/// symmetric.
void add_fill(std::vector<std::vector<std::uint32_t>>& list, std::uint32_t fill) {
    struct Block {
        std::uint32_t column, level;
    };
    std::vector<std::vector<Block>> upper(list.size());
    std::vector<std::uint32_t> level(list.size(), CompactPattern::none);
    for (std::uint32_t row = 0; row < list.size(); ++row) {
        std::set<std::uint32_t> columns(list[row].begin(), list[row].end());
        for (const std::uint32_t c : columns) level[c] = 0;
        for (auto at = columns.begin(); at != columns.end() && *at < row; ++at)
            for (const Block& b : upper[*at]) {
                const std::uint32_t of_fill = level[*at] + b.level + 1;
                if (b.column == row || of_fill > fill) continue;
                columns.insert(b.column);
                level[b.column] = std::min(level[b.column], of_fill);
            }
        list[row].assign(columns.begin(), columns.end());
        for (const std::uint32_t c : columns) {
            if (c > row) upper[row].push_back({c, level[c]});
            level[c] = CompactPattern::none;
        }
    }
}

/// Sorts rows by level; cells of one level keep their order.
void set_levels(const std::vector<std::vector<std::uint32_t>>& list, CompactPattern& p) {
    std::vector<std::uint32_t> level(list.size(), 0);
    std::uint32_t levels = 0;
    for (std::uint32_t c = 0; c < list.size(); ++c) {
        for (const std::uint32_t k : list[c])
            if (k < c) level[c] = std::max(level[c], level[k] + 1);
        levels = std::max(levels, level[c] + 1);
    }
    p.level.assign(levels + 1, 0);
    for (const std::uint32_t l : level) ++p.level[l + 1];
    std::partial_sum(p.level.begin(), p.level.end(), p.level.begin());
    p.cell.resize(list.size());
    std::vector<std::uint32_t> next = p.level;
    for (std::uint32_t c = 0; c < list.size(); ++c) p.cell[next[level[c]]++] = c;
}

}  // namespace

std::uint32_t default_fill(std::size_t cells, const std::vector<CompactFace>& faces) {
    const auto interior =
        std::count_if(faces.begin(), faces.end(), [](const CompactFace& f) { return !f.border; });
    constexpr double faces_per_cell = 2.5;  // 2 in a plane, 3 in space
    return static_cast<double>(interior) < faces_per_cell * static_cast<double>(cells) ? 4 : 0;
}

CompactPattern make_compact_pattern(std::size_t cells, const std::vector<CompactFace>& faces,
                                    std::uint32_t fill) {
    CompactPattern p;
    auto list = neighbours(cells, faces);
    add_fill(list, fill);
    set_levels(list, p);
    std::vector<std::uint32_t> row(cells);
    for (std::uint32_t r = 0; r < cells; ++r) row[p.cell[r]] = r;

    p.first.assign(1, 0);
    for (std::uint32_t r = 0; r < cells; ++r) {
        const auto begin = static_cast<std::ptrdiff_t>(p.column.size());
        for (const std::uint32_t k : list[p.cell[r]]) p.column.push_back(row[k]);
        std::sort(p.column.begin() + begin, p.column.end());
        const auto above = std::upper_bound(p.column.begin() + begin, p.column.end(), r);
        p.upper.push_back(static_cast<std::uint32_t>(above - p.column.begin()));
        p.first.push_back(static_cast<std::uint32_t>(p.column.size()));
    }
    const auto block = [&](std::uint32_t r, std::uint32_t column) {
        const auto begin = p.column.begin() + p.first[r], end = p.column.begin() + p.first[r + 1];
        return static_cast<std::uint32_t>(std::lower_bound(begin, end, column) - p.column.begin());
    };
    p.reverse.resize(p.column.size());
    for (std::uint32_t r = 0; r < cells; ++r)
        for (std::uint32_t b = p.first[r]; b < p.first[r + 1]; ++b) p.reverse[b] = block(p.column[b], r);

    std::vector<char> taken(p.column.size(), 0);
    p.first_border.assign(cells + 1, 0);
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        if (faces[f].border) {
            p.border.push_back(f);
            ++p.first_border[row[faces[f].left] + 1];
            continue;
        }
        const std::uint32_t l = row[faces[f].left], r = row[faces[f].right], forward = block(l, r);
        p.interior.push_back(f);
        p.left_right.push_back(taken[forward] ? CompactPattern::none : forward);
        p.right_left.push_back(taken[forward] ? CompactPattern::none : block(r, l));
        taken[forward] = taken[block(r, l)] = 1;
    }
    std::partial_sum(p.first_border.begin(), p.first_border.end(), p.first_border.begin());
    std::stable_sort(p.border.begin(), p.border.end(), [&](std::uint32_t a, std::uint32_t b) {
        return row[faces[a].left] < row[faces[b].left];
    });
    return p;
}

}  // namespace hemoflux::fluid
