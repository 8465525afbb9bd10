// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/label_map.h"

#include <gmock/gmock.h>

#include <glm/geometric.hpp>
#include <limits>
#include <set>
#include <tuple>

#include "tests/unit/test_volumes.h"

namespace pellucid {
namespace {

using test::makeVolume;
using testing::HasSubstr;

TEST(LabelMap, TakesTheFirstComponentAsIds) {
    const VolumePtr volume = makeVolume<float>({2, 2, 1}, {0, 9, 7, 9, 65535, 9, 7, 9}, {}, 2);
    const auto map = labelMapFromVolume(*volume);
    ASSERT_TRUE(map);
    EXPECT_EQ((*map)->ids, (std::vector<std::uint16_t>{0, 7, 65535, 7}));
    EXPECT_EQ((*map)->grid, volume->grid());
    ASSERT_EQ((*map)->labels.size(), 2u);  // Background is no label.
    EXPECT_EQ((*map)->labels.at(7).name, "label 7");
    EXPECT_EQ((*map)->labels.at(65535).name, "label 65535");
    EXPECT_TRUE((*map)->labels.at(7).visible);
}

TEST(LabelMap, IdsAreThePhysicalValues) {
    const auto map = labelMapFromVolume(*makeVolume<std::int16_t>({2, 1, 1}, {-3, 0}, {-2.0, 4.0, ""}));
    ASSERT_TRUE(map);
    EXPECT_EQ((*map)->ids, (std::vector<std::uint16_t>{10, 4}));
}

TEST(LabelMap, ValuesThatAreNoIdsAreRefusedWithTheVoxel) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const struct {
        const char* name;
        float value;
        const char* said;
    } cases[] = {{"negative", -1.0f, "-1"},
                 {"fraction", 2.5f, "2.5"},
                 {"too large", 65536.0f, "65536"},
                 {"NaN", nan, "nan"}};
    for (const auto& test : cases) {
        SCOPED_TRACE(test.name);
        std::vector<float> values(24, 1.0f);
        values[10] = test.value;  // Of 2 x 3 x 4: voxel (0, 2, 1).
        const auto map = labelMapFromVolume(*makeVolume<float>({2, 3, 4}, values));
        ASSERT_FALSE(map);
        EXPECT_EQ(map.error().code, ErrorCode::InvalidArgument);
        EXPECT_THAT(map.error().message, HasSubstr("voxel (0, 2, 1)"));
        EXPECT_THAT(map.error().message, HasSubstr(test.said));
    }
}

TEST(LabelMap, ColoursAreValidAndDistinct) {
    std::vector<std::uint16_t> values(2000);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::uint16_t>(i + 1);
    const auto map = labelMapFromVolume(*makeVolume<std::uint16_t>({2000, 1, 1}, values));
    ASSERT_TRUE(map);
    std::set<std::tuple<double, double, double>> seen;
    for (const auto& [id, label] : (*map)->labels) {
        for (int c = 0; c < 3; ++c) {
            EXPECT_GE(label.color[c], 0.0);
            EXPECT_LE(label.color[c], 1.0);
        }
        EXPECT_TRUE(seen.emplace(label.color.x, label.color.y, label.color.z).second) << id;
    }
    // The first ones, which people compare, are told apart by the eye: 40 grey levels in RGB.
    for (std::uint16_t a = 1; a <= 12; ++a)
        for (std::uint16_t b = 1; b < a; ++b)
            EXPECT_GT(glm::length((*map)->labels.at(a).color - (*map)->labels.at(b).color), 40.0 / 255.0)
                << a << " " << b;
}

}  // namespace
}  // namespace pellucid
