// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcrleerg.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmjpeg/djencode.h>
#include <dcmtk/dcmjpls/djencode.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <fstream>
#include <random>

#include "io/dicom_series.h"
#include "io/dicom_structure.h"
#include "tests/support/allocation_watch.h"
#include "tests/support/synthetic_dicom.h"

namespace pellucid::io {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Far above what a small file needs (DCMTK's dictionary and buffers), far below what a lying header asks
/// for.
constexpr std::size_t kMostBytes = 16 << 20;

std::string contentOf(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
}

/// The error of loading these bytes; fails when a large block was allocated on the way.
Error errorOf(const std::string& bytes) {
    const test::TemporaryFolder folder;
    const fs::path file = folder.path() / "hostile.dcm";
    std::ofstream(file, std::ios::binary) << bytes;
    test::resetLargestAllocation();
    const auto volume = loadDicom({file});
    EXPECT_LT(test::largestAllocation(), kMostBytes);
    if (volume) return {ErrorCode::InvalidArgument, "it was loaded", {}};
    return volume.error();
}

std::string sequenceStart() {
    return std::string("\x08\x00\x15\x11SQ\0\0\xFF\xFF\xFF\xFF", 12);
}
std::string itemStart() {
    return std::string("\xFE\xFF\x00\xE0\xFF\xFF\xFF\xFF", 8);
}

/// Preamble and meta information with this transfer syntax.
std::string headOf(const std::string& syntax) {
    std::string uid = syntax.size() % 2 == 1 ? syntax + '\0' : syntax;
    return std::string(128, '\0') + "DICM" + std::string("\x02\x00\x10\x00UI", 6) +
           static_cast<char>(uid.size()) + '\0' + uid;
}

std::string sliceBytes(const std::function<void(test::SyntheticFile&)>& edit = {}) {
    test::SyntheticFile file = test::makeSlice({}, 0);
    if (edit) edit(file);
    return file.encoded(test::DicomEncoding::ExplicitLittle);
}

TEST(DicomHostile, DeepNestingEndsWithAnError) {
    for (const int depth : {65, 10000, 200000}) {
        std::string bytes = headOf("1.2.840.10008.1.2.1");
        for (int i = 0; i < depth; ++i) bytes += sequenceStart() + itemStart();
        const Error error = errorOf(bytes);
        EXPECT_EQ(error.code, ErrorCode::Corrupt);
        EXPECT_THAT(error.message, HasSubstr("nest deeper than 64"));
    }
}

TEST(DicomHostile, DeepNestingOfKnownLengthEndsWithAnError) {
    // Built from the inside out in implicit VR, where nothing but the content shows a sequence.
    std::string inner;
    for (int i = 0; i < 2000; ++i) {
        const auto number = [](std::size_t n) {
            std::string text;
            for (int b = 0; b < 4; ++b) text += static_cast<char>(n >> 8 * b & 0xFF);
            return text;
        };
        inner = std::string("\xFE\xFF\x00\xE0", 4) + number(inner.size()) + inner;
        inner = std::string("\x08\x00\x15\x11", 4) + number(inner.size()) + inner;
    }
    EXPECT_THAT(errorOf(headOf("1.2.840.10008.1.2") + inner).message, HasSubstr("nest deeper than 64"));
}

TEST(DicomHostile, NestingWithinTheLimitIsRead) {
    std::string nested;
    for (int i = 0; i < 60; ++i) nested += sequenceStart() + itemStart();
    for (int i = 0; i < 60; ++i)
        nested += std::string("\xFE\xFF\x0D\xE0\0\0\0\0\xFE\xFF\xDD\xE0\0\0\0\0", 16);
    // As the first element of a whole slice.
    std::string bytes = sliceBytes();
    const std::size_t start = bytes.find(std::string("\x08\x00\x16\x00UI", 6));
    bytes.insert(start, std::string("\x08\x00\x06\x00SQ\0\0\xFF\xFF\xFF\xFF", 12) + itemStart() + nested +
                            std::string("\xFE\xFF\x0D\xE0\0\0\0\0\xFE\xFF\xDD\xE0\0\0\0\0", 16));
    EXPECT_EQ(errorOf(bytes).message, "it was loaded");
}

TEST(DicomHostile, LengthsAreNotBelieved) {
    // An element of 2 GB, an image of 65535 x 65535, a fragment of 4 GB.
    const std::string head = headOf("1.2.840.10008.1.2.1");
    EXPECT_THAT(errorOf(head + std::string("\x08\x00\x16\x00OB\0\0\x00\x00\x00\x80", 12)).message,
                HasSubstr("(0008,0016) at byte 160 is to have 2147483648 bytes, and 0 are there"));
    const Error image = errorOf(sliceBytes([](test::SyntheticFile& f) {
        f.setShort(0x00280010, 65535);
        f.setShort(0x00280011, 65535);
    }));
    EXPECT_THAT(image.message, HasSubstr("need 8589672450 bytes of pixel data, and 70 are there"));
    EXPECT_EQ(
        errorOf(headOf("1.2.840.10008.1.2.5") + std::string("\xE0\x7F\x10\x00OB\0\0\xFF\xFF\xFF\xFF", 12) +
                std::string("\xFE\xFF\x00\xE0\xFE\xFF\xFF\xFF", 8))
            .code,
        ErrorCode::Corrupt);
}

/// A slice with an image of 65535 x 65535 pixels in a few compressed bytes.
std::string tinyHugeImage(const std::string& syntax) {
    std::string bytes = sliceBytes([](test::SyntheticFile& f) {
        f.setShort(0x00280010, 65535);
        f.setShort(0x00280011, 65535);
        f.erase(0x7FE00010);
    });
    const std::size_t start = bytes.find(std::string("\x08\x00\x16\x00UI", 6));
    bytes = headOf(syntax) + bytes.substr(start) + std::string("\xE0\x7F\x10\x00OB\0\0\xFF\xFF\xFF\xFF", 12);
    bytes += std::string("\xFE\xFF\x00\xE0\0\0\0\0\xFE\xFF\x00\xE0\x40\0\0\0", 16) + std::string(64, '\x55');
    return bytes + std::string("\xFE\xFF\xDD\xE0\0\0\0\0", 8);
}

TEST(DicomHostile, ACompressedImageCannotPromiseMoreThanItHolds) {
    for (const char* syntax : {"1.2.840.10008.1.2.5", "1.2.840.10008.1.2.4.70", "1.2.840.10008.1.2.4.51"}) {
        const Error error = errorOf(tinyHugeImage(syntax));
        EXPECT_EQ(error.code, ErrorCode::Corrupt);
        EXPECT_THAT(error.message, HasSubstr("64 compressed bytes cannot hold them")) << syntax;
    }
}

TEST(DicomHostile, CompressionThatCannotBeDecodedIsRefusedByName) {
    const Error error = errorOf(tinyHugeImage("1.2.840.10008.1.2.4.90"));
    EXPECT_EQ(error.code, ErrorCode::Unsupported);
    EXPECT_THAT(error.message, HasSubstr("JPEG 2000"));
    EXPECT_THAT(errorOf(tinyHugeImage("1.2.3.4")).message,
                HasSubstr("the transfer syntax \"1.2.3.4\" is not known"));
}

TEST(DicomHostile, ADeflatedFileCannotGrowWithoutEnd) {
    // 2 GB of zeros as one element: about 2 MB deflated.
    z_stream zlib{};
    ASSERT_EQ(deflateInit2(&zlib, 9, Z_DEFLATED, -MAX_WBITS, 9, Z_DEFAULT_STRATEGY), Z_OK);
    std::string bytes = headOf("1.2.840.10008.1.2.1.99");
    std::string chunk(1 << 20, '\0');
    std::vector<char> out(1 << 16);
    const auto put = [&](std::string& input, int flush) {
        zlib.next_in = reinterpret_cast<Bytef*>(input.data());
        zlib.avail_in = static_cast<uInt>(input.size());
        do {
            zlib.next_out = reinterpret_cast<Bytef*>(out.data());
            zlib.avail_out = static_cast<uInt>(out.size());
            deflate(&zlib, flush);
            bytes.append(out.data(), out.size() - zlib.avail_out);
        } while (zlib.avail_out == 0);
    };
    std::string start("\x08\x00\x16\x00OB\0\0\x00\x00\x00\x7F", 12);
    put(start, Z_NO_FLUSH);
    for (int i = 0; i < 16; ++i) put(chunk, i == 15 ? Z_FINISH : Z_NO_FLUSH);
    deflateEnd(&zlib);
    const Error error = errorOf(bytes);
    EXPECT_EQ(error.code, ErrorCode::TooLarge);
    EXPECT_THAT(error.message, HasSubstr("inflates to more than"));
}

TEST(DicomHostile, DamagedDeflateIsAnError) {
    const Error error = errorOf(headOf("1.2.840.10008.1.2.1.99") + std::string(200, '\xFF'));
    EXPECT_EQ(error.code, ErrorCode::Corrupt);
    EXPECT_THAT(error.message, HasSubstr("deflated data is damaged"));
}

/// A whole small slice in each transfer syntax, then thousands of copies with a few bytes changed or the end
/// cut off. None may crash, hang or allocate by what it says; one that still loads is as large as the
/// original.
class DicomMutation : public testing::TestWithParam<E_TransferSyntax> {};

TEST_P(DicomMutation, ChangedBytesEndWell) {
    static const bool registered = [] {
        DcmRLEEncoderRegistration::registerCodecs();
        DJEncoderRegistration::registerCodecs(ECC_lossyYCbCr, EUC_never);
        DJLSEncoderRegistration::registerCodecs();
        return true;
    }();
    ASSERT_TRUE(registered);
    const test::TemporaryFolder folder;
    test::SyntheticSeries series;
    series.slices = 1;
    series.size = {17, 13};
    const fs::path file = test::writeSeries(series, folder.path())[0];
    DcmFileFormat format;
    ASSERT_TRUE(format.loadFile(file.c_str()).good());
    ASSERT_TRUE(format.loadAllDataIntoMemory().good());
    ASSERT_TRUE(format.getDataset()->chooseRepresentation(GetParam(), nullptr).good());
    ASSERT_TRUE(format.saveFile(file.c_str(), GetParam()).good());
    const std::string whole = contentOf(file);

    constexpr unsigned kSeed = 20260101;
    constexpr int kRounds = 1500;
    std::mt19937 random(kSeed);
    int survivors = 0;
    test::resetLargestAllocation();
    for (int round = 0; round < kRounds; ++round) {
        std::string bytes = whole;
        const unsigned changes = 1 + random() % 4;
        for (unsigned n = 0; n < changes; ++n) {
            // Behind the preamble, where every byte counts.
            const std::size_t at = 132 + random() % (bytes.size() - 132);
            bytes[at] = static_cast<char>(random() % 3 == 0 ? 0xFF : random() & 0xFF);
        }
        if (random() % 8 == 0) bytes.resize(132 + random() % (bytes.size() - 132));
        fs::remove(file);  // Rewriting in place makes some file systems wait for the disk.
        std::ofstream(file, std::ios::binary) << bytes;
        const auto volume = loadDicom({file});
        if (!volume) continue;
        ++survivors;
        ASSERT_LE((*volume)->bytes().size(), whole.size() * 16) << "seed " << kSeed << ", round " << round;
    }
    EXPECT_LT(test::largestAllocation(), kMostBytes);
    EXPECT_GT(survivors, 0);  // Or the changes hit nothing but the first check.
}

INSTANTIATE_TEST_SUITE_P(Syntaxes, DicomMutation,
                         testing::Values(EXS_LittleEndianExplicit, EXS_LittleEndianImplicit,
                                         EXS_BigEndianExplicit, EXS_DeflatedLittleEndianExplicit,
                                         EXS_RLELossless, EXS_JPEGProcess14SV1, EXS_JPEGLSLossless),
                         [](const auto& test) {
                             std::string name;
                             for (const char c : std::string(DcmXfer(test.param).getXferID()))
                                 name += c == '.' ? '_' : c;
                             return name;
                         });

}  // namespace
}  // namespace pellucid::io
