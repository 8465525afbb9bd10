// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>

#include "io/dicom_series.h"

namespace pellucid::io {
namespace {

namespace fs = std::filesystem;

const fs::path kHead = fs::path(PELLUCID_TEST_DATA) / "ct-head-64";

TEST(DicomSample, LoadsAllVoxelsBitExactly) {
    const auto volume = loadDicom({kHead});
    ASSERT_TRUE(volume) << volume.error().text();
    const Volume& v = **volume;
    EXPECT_EQ(v.grid().size, glm::ivec3(64, 64, 93));
    EXPECT_EQ(spacingMm(v.grid()), glm::dvec3(3.2, 3.2, 1.5));
    EXPECT_EQ(v.type(), VoxelType::Int16);
    EXPECT_EQ(v.storedRange(), (ValueRange{0, 3926}));
    EXPECT_EQ(v.mapping(), (ValueMapping{1.0, 0.0, ""}));
    EXPECT_TRUE(v.info().warnings.empty());
    const auto bytes = v.bytes();
    // tests/data/README.md: of the same voxels distributed as a raw file.
    EXPECT_EQ(crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())),
              0xc97c16e0u);
}

TEST(DicomSample, FolderAndFileListAgree) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(kHead)) files.push_back(entry.path());
    ASSERT_EQ(files.size(), 93u);
    std::sort(files.begin(), files.end(), std::greater<>());
    const auto list = loadDicom(files);
    const auto folder = loadDicom({kHead});
    ASSERT_TRUE(list && folder);
    EXPECT_EQ((*list)->grid(), (*folder)->grid());
    EXPECT_TRUE(std::equal((*list)->bytes().begin(), (*list)->bytes().end(), (*folder)->bytes().begin(),
                           (*folder)->bytes().end()));
}

TEST(DicomSample, AxesPointAsThePatientLies) {
    const auto volume = loadDicom({kHead});
    ASSERT_TRUE(volume);
    const Grid& grid = (*volume)->grid();
    // PatientOrientation (0020,0020) of these files is L\P: rows run to the left, columns to posterior.
    EXPECT_EQ(orientationLetters(glm::dvec3(grid.patientFromIndex[0])), "L");
    EXPECT_EQ(orientationLetters(glm::dvec3(grid.patientFromIndex[1])), "P");
    EXPECT_EQ(orientationLetters(glm::dvec3(grid.patientFromIndex[2])), "S");
}

TEST(DicomSample, MissingSliceIsRefused) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(kHead)) {
        if (entry.path().filename() != "CTHead47.dcm") files.push_back(entry.path());
    }
    const auto volume = loadDicom(files);
    ASSERT_FALSE(volume);
    EXPECT_EQ(volume.error().code, ErrorCode::Inconsistent);
    EXPECT_NE(volume.error().message.find("missing between CTHead46.dcm and CTHead48.dcm"), std::string::npos)
        << volume.error().message;
}

}  // namespace
}  // namespace pellucid::io
