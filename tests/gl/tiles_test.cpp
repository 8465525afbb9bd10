// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/passes/tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace pellucid::renderer {
namespace {

TEST(Tiles, CoverEveryPixelOnce) {
    for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(3, 1000), glm::ivec2(1024, 768),
                                  glm::ivec2(517, 333), glm::ivec2(5000, 3)}) {
        for (const double wanted : {0.1, 1.0, 63.0, 4096.0, 50000.0, 1e12}) {
            std::vector<int> covered(static_cast<std::size_t>(size.x * size.y), 0);
            double changing = wanted;
            for (TileCutter cutter(size); !cutter.done();) {
                const Tile tile = cutter.next(changing);
                ASSERT_GT(tile.size.x, 0);
                ASSERT_GT(tile.size.y, 0);
                for (int y = 0; y < tile.size.y; ++y)
                    for (int x = 0; x < tile.size.x; ++x)
                        ++covered.at(
                            static_cast<std::size_t>((tile.origin.y + y) * size.x + tile.origin.x + x));
                changing = changing > 1e6 ? changing : changing * 1.7;
            }
            EXPECT_TRUE(std::all_of(covered.begin(), covered.end(), [](int n) { return n == 1; }))
                << size.x << " " << size.y << " " << wanted;
        }
    }
}

TEST(Tiles, AreNotMuchLargerThanWanted) {
    for (const double wanted : {64.0, 1000.0, 20000.0})
        for (TileCutter cutter({1000, 700}); !cutter.done();) {
            const Tile tile = cutter.next(wanted);
            EXPECT_LE(tile.size.x * tile.size.y, 1.5 * wanted + 16);
        }
}

TEST(Tiles, BudgetFollowsTheMostExpensiveTile) {
    TileBudget budget(20.0, 0.001);
    EXPECT_DOUBLE_EQ(budget.wantedPixels(), 20000.0);
    budget.took(1000, 0.001);                          // background: cheap
    EXPECT_DOUBLE_EQ(budget.wantedPixels(), 40000.0);  // but no more than twice as hopeful as before
    budget.took(1000, 4.0);
    EXPECT_DOUBLE_EQ(budget.wantedPixels(), 5000.0);
    budget.took(1000, 0.001);
    EXPECT_DOUBLE_EQ(budget.wantedPixels(), 5000.0);
    EXPECT_DOUBLE_EQ(budget.msPerPixel(), 0.004);
}

}  // namespace
}  // namespace pellucid::renderer
