// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcrleerg.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmjpeg/djencode.h>
#include <dcmtk/dcmjpls/djencode.h>
#include <gtest/gtest.h>

#include "io/dicom_series.h"
#include "tests/support/synthetic_dicom.h"

namespace pellucid::io {
namespace {

namespace fs = std::filesystem;

/// Encoders for the time of a test; the reader registers its decoders itself.
class DicomCodecs : public testing::TestWithParam<E_TransferSyntax> {
protected:
    static void SetUpTestSuite() {
        DcmRLEEncoderRegistration::registerCodecs();
        DJEncoderRegistration::registerCodecs(ECC_lossyYCbCr, EUC_never);
        DJLSEncoderRegistration::registerCodecs();
    }
    static void TearDownTestSuite() {
        DcmRLEEncoderRegistration::cleanup();
        DJEncoderRegistration::cleanup();
        DJLSEncoderRegistration::cleanup();
    }
};

void transcode(const fs::path& file, E_TransferSyntax syntax) {
    DcmFileFormat format;
    ASSERT_TRUE(format.loadFile(file.c_str()).good());
    ASSERT_TRUE(format.loadAllDataIntoMemory().good());
    ASSERT_TRUE(format.getDataset()->chooseRepresentation(syntax, nullptr).good());
    ASSERT_TRUE(format.saveFile(file.c_str(), syntax).good());
}

TEST_P(DicomCodecs, DecodesBitExactly) {
    for (const bool isSigned : {false, true}) {
        for (const int stored : {12, 16}) {
            // DCMTK's JPEG-LS encoder stops the program on signed values of fewer bits than their container.
            if (GetParam() == EXS_JPEGLSLossless && isSigned && stored < 16) continue;
            test::SyntheticSeries series;
            series.size = {33, 21};
            series.bitsStored = stored;
            series.highBit = stored - 1;
            series.isSigned = isSigned;
            const std::int64_t count = std::int64_t{1} << stored;
            series.value = [=](int i, int j, int k) {
                const std::int64_t mixed = (i * 977 + j * 3181 + k * 557 + i * j) % count;
                return isSigned ? mixed - count / 2 : mixed;
            };
            const test::TemporaryFolder folder;
            const auto files = test::writeSeries(series, folder.path());
            const auto plain = loadDicom({folder.path()});
            for (const fs::path& file : files) transcode(file, GetParam());
            const auto packed = loadDicom({folder.path()});
            ASSERT_TRUE(plain) << plain.error().text();
            ASSERT_TRUE(packed) << packed.error().text();
            EXPECT_EQ((*packed)->type(), isSigned ? VoxelType::Int16 : VoxelType::UInt16);
            EXPECT_EQ((*packed)->grid(), (*plain)->grid());
            EXPECT_TRUE(std::equal((*packed)->bytes().begin(), (*packed)->bytes().end(),
                                   (*plain)->bytes().begin(), (*plain)->bytes().end()))
                << "signed " << isSigned << ", bits " << stored;
            EXPECT_DOUBLE_EQ((*packed)->stored({5, 4, 3}), static_cast<double>(series.value(5, 4, 3)));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Lossless, DicomCodecs,
                         testing::Values(EXS_DeflatedLittleEndianExplicit, EXS_BigEndianExplicit,
                                         EXS_RLELossless, EXS_JPEGProcess14, EXS_JPEGProcess14SV1,
                                         EXS_JPEGLSLossless),
                         [](const auto& test) {
                             std::string name;
                             for (const char c : std::string(DcmXfer(test.param).getXferID()))
                                 name += c == '.' ? '_' : c;
                             return name;
                         });

}  // namespace
}  // namespace pellucid::io
