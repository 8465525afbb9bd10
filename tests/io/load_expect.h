// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// What the tests of the volume formats share.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "io/load.h"
#include "tests/support/file_bytes.h"

namespace pellucid::io {

/// Loads one file; a refusal is a test failure with its sentence, and gives null.
inline VolumePtr loaded(const std::filesystem::path& file, const LoadOptions& options = {}) {
    const auto volume = loadVolume({file}, options);
    if (!volume) {
        ADD_FAILURE() << volume.error().text();
        return nullptr;
    }
    return *volume;
}

/// The error of a file that must be refused; its sentence must name the file.
inline Error refusal(const std::filesystem::path& file, const LoadOptions& options = {}) {
    const auto volume = loadVolume({file}, options);
    if (volume) {
        ADD_FAILURE() << file << " was loaded";
        return {};
    }
    EXPECT_THAT(volume.error().text(), testing::HasSubstr(file.filename().string()));
    return volume.error();
}

inline void expectRefused(const std::filesystem::path& file, ErrorCode code,
                          const std::vector<std::string>& words) {
    const Error error = refusal(file);
    EXPECT_EQ(static_cast<int>(error.code), static_cast<int>(code)) << error.text();
    for (const std::string& word : words) EXPECT_THAT(error.text(), testing::HasSubstr(word));
}

template <class T>
void expectVoxels(const Volume& volume, const std::vector<T>& expected) {
    ASSERT_EQ(volume.bytes().size(), expected.size() * sizeof(T));
    EXPECT_EQ(std::memcmp(volume.bytes().data(), expected.data(), volume.bytes().size()), 0);
}

/// Columns of patientFromIndex, to a tolerance given by how the format stores its numbers.
inline void expectPlaced(const Grid& grid, const glm::dmat4& expected, double tolerance) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            EXPECT_NEAR(grid.patientFromIndex[column][row], expected[column][row], tolerance)
                << "column " << column << " row " << row;
        }
    }
}

inline std::string warningsOf(const Volume& volume) {
    std::string all;
    for (const Warning& warning : volume.info().warnings) all += warning.message + "\n";
    return all;
}

}  // namespace pellucid::io
