// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/nrrd_write.h"

#include <algorithm>

#include "tests/io/load_expect.h"

namespace pellucid::io {
namespace {

TEST(NrrdWrite, ReadsBackBitForBit) {
    const test::TempFolder folder;
    Grid grid = axisAlignedGrid({4, 3, 2}, {0.1, 1.0 / 3.0, 7e-5}, {-1e3, 0.2, 1e-9});
    grid.patientFromIndex[1][2] = 0.123456789012345678;
    for (const VoxelType type :
         {VoxelType::Int8, VoxelType::UInt8, VoxelType::Int16, VoxelType::UInt16, VoxelType::Int32,
          VoxelType::UInt32, VoxelType::Float32, VoxelType::Float64}) {
        for (const int components : {1, 3}) {
            std::vector<std::byte> bytes(24 * bytesPerComponent(type) * static_cast<std::size_t>(components));
            for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(i * 37 % 63);
            const auto volume = Volume::make(grid, type, components, bytes, {1.0, 0.0, "HU"}).value();
            const auto file = folder.path() / "a.nrrd";
            const auto written = writeNrrd(file, *volume);
            ASSERT_TRUE(written) << written.error().text();
            const auto back = loaded(file);
            ASSERT_TRUE(back) << name(type);
            EXPECT_EQ(back->grid(), grid);
            EXPECT_EQ(back->type(), type);
            EXPECT_EQ(back->components(), components);
            EXPECT_EQ(back->mapping(), volume->mapping());
            EXPECT_TRUE(std::ranges::equal(back->bytes(), volume->bytes())) << name(type);
            EXPECT_EQ(warningsOf(*back), "");
        }
    }
}

TEST(NrrdWrite, RefusesWhatTheFormatCannotHold) {
    const test::TempFolder folder;
    const auto volume =
        Volume::make(axisAlignedGrid({1, 1, 1}), VoxelType::UInt8, 1, {std::byte{1}}, {2.0, 0.0, ""}).value();
    EXPECT_EQ(writeNrrd(folder.path() / "a.nrrd", *volume).error().code, ErrorCode::InvalidArgument);
}

}  // namespace
}  // namespace pellucid::io
