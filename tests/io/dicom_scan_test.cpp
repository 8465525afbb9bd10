// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "io/dicom_series.h"
#include "tests/support/synthetic_dicom.h"

namespace pellucid::io {
namespace {

namespace fs = std::filesystem;
using test::SyntheticFile;
using test::SyntheticSeries;
using test::TemporaryFolder;
using test::writeSeries;
using testing::HasSubstr;

void writeText(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

/// An item with a ReferencedFileID, explicit little endian, as a DICOMDIR has it.
std::string directoryRecord(std::string id) {
    if (id.size() % 2 == 1) id += ' ';
    const auto two = [](std::size_t n) {
        return std::string{static_cast<char>(n & 0xFF), static_cast<char>(n >> 8)};
    };
    const std::string element = std::string("\x04\x00\x00\x15", 4) + "CS" + two(id.size()) + id;
    return std::string("\xFE\xFF\x00\xE0", 4) + two(element.size()) + std::string(2, '\0') + element;
}

void writeDirectory(const fs::path& file, const std::vector<std::string>& ids) {
    SyntheticFile directory;
    std::string records;
    for (const std::string& id : ids) records += directoryRecord(id);
    directory.setSequence(0x00041220, records);
    directory.write(file);
}

TEST(DicomScan, GroupsByStudyAndSeries) {
    const TemporaryFolder folder;
    SyntheticSeries series;
    writeSeries(series, folder.path() / "a");
    series.seriesUid = "1.2.3.4.6";
    series.description = "Thin";
    series.slices = 3;
    writeSeries(series, folder.path() / "b" / "c");
    const auto scan = scanDicom({folder.path()});
    ASSERT_TRUE(scan) << scan.error().text();
    ASSERT_EQ(scan->series.size(), 2u);
    EXPECT_EQ(scan->series[0].uid, "1.2.3.4.5");
    EXPECT_EQ(scan->series[0].files.size(), 4u);
    EXPECT_EQ(scan->series[1].description, "Thin");
    EXPECT_EQ(scan->series[1].modality, "CT");
    EXPECT_TRUE(scan->leftOut.empty());
}

TEST(DicomScan, SaysHowToChooseBetweenSeries) {
    const TemporaryFolder folder;
    SyntheticSeries series;
    writeSeries(series, folder.path() / "a");
    series.seriesUid = "1.2.3.4.6";
    series.description = "Thin";
    series.slices = 3;
    writeSeries(series, folder.path() / "b");
    const auto volume = loadDicom({folder.path()});
    ASSERT_FALSE(volume);
    EXPECT_EQ(volume.error().code, ErrorCode::Inconsistent);
    EXPECT_THAT(volume.error().message, HasSubstr("--series"));
    EXPECT_THAT(volume.error().message, HasSubstr("1.2.3.4.5  CT \"Synthetic\", 4 files"));
    EXPECT_THAT(volume.error().message, HasSubstr("1.2.3.4.6  CT \"Thin\", 3 files"));
    LoadOptions options;
    options.seriesUid = "1.2.3.4.6";
    const auto chosen = loadDicom({folder.path()}, options);
    ASSERT_TRUE(chosen) << chosen.error().text();
    EXPECT_EQ((*chosen)->grid().size.z, 3);
    options.seriesUid = "9.9";
    EXPECT_EQ(loadDicom({folder.path()}, options).error().code, ErrorCode::NotFound);
}

TEST(DicomScan, LeavesOutWhatIsNoSliceAndTellsWhy) {
    const TemporaryFolder folder;
    SyntheticSeries series;
    writeSeries(series, folder.path());
    writeText(folder.path() / "notes.txt", "not DICOM");
    writeText(folder.path() / "empty", "");
    SyntheticFile colour = test::makeSlice(series, 0);
    colour.setShort(0x00280002, 3);
    colour.write(folder.path() / "colour.dcm");
    SyntheticFile frames = test::makeSlice(series, 0);
    frames.setText(0x00280008, "IS", "12");
    frames.write(folder.path() / "frames.dcm");
    SyntheticFile plan = test::makeSlice(series, 0);
    plan.setText(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.481.2");
    plan.write(folder.path() / "dose.dcm");
    SyntheticFile report = test::makeSlice(series, 0);
    report.setText(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.88.11");
    report.erase(0x00280010);
    report.write(folder.path() / "report.dcm");
    const auto volume = loadDicom({folder.path()});
    ASSERT_TRUE(volume) << volume.error().text();
    std::string all;
    for (const Warning& warning : (*volume)->info().warnings) all += warning.message + "\n";
    EXPECT_THAT(all, HasSubstr("notes.txt: not a DICOM file"));
    EXPECT_THAT(all, HasSubstr("empty: not a DICOM file"));
    EXPECT_THAT(all, HasSubstr("colour.dcm: CT Image Storage: a colour image"));
    EXPECT_THAT(all, HasSubstr("frames.dcm: CT Image Storage: 12 frames"));
    EXPECT_THAT(all, HasSubstr("dose.dcm: RT Dose Storage: not a slice"));
    EXPECT_THAT(all, HasSubstr("report.dcm: Basic Text SR Storage: no image"));
    EXPECT_EQ((*volume)->info().warnings.size(), 6u);
}

TEST(DicomScan, SumsUpManyFilesLeftOut) {
    const TemporaryFolder folder;
    writeSeries({}, folder.path());
    for (int i = 0; i < 30; ++i) writeText(folder.path() / fmt::format("note{}.txt", i), "text");
    const auto scan = scanDicom({folder.path()});
    ASSERT_TRUE(scan);
    EXPECT_EQ(scan->leftOut.size(), 30u);
    ASSERT_EQ(scan->series[0].warnings.size(), 9u);
    EXPECT_EQ(scan->series[0].warnings.back().message, "left out 22 more files");
}

TEST(DicomScan, TakesAListOfFilesInAnyOrderAndEachOnce) {
    const TemporaryFolder folder;
    auto files = writeSeries({}, folder.path());
    std::swap(files[0], files[2]);
    files.push_back(files[1]);
    files.push_back(folder.path() / "." / files[1].filename());
    const auto volume = loadDicom(files);
    ASSERT_TRUE(volume) << volume.error().text();
    EXPECT_EQ((*volume)->grid().size.z, 4);
}

TEST(DicomScan, FollowsADirectoryFile) {
    const TemporaryFolder folder;
    SyntheticSeries series;
    series.fileName = [](int k) { return fmt::format("IM{}", k); };
    writeSeries(series, folder.path() / "PAT" / "SER");
    writeSeries({}, folder.path() / "OTHER");
    const fs::path directory = folder.path() / "DICOMDIR";
    writeDirectory(directory, {"PAT\\SER\\IM2", "PAT\\SER\\IM0", "PAT\\SER\\IM3", "PAT\\SER\\IM1"});
    const auto volume = loadDicom({directory});
    ASSERT_TRUE(volume) << volume.error().text();
    EXPECT_EQ((*volume)->grid().size.z, 4);
    EXPECT_TRUE((*volume)->info().warnings.empty());
}

TEST(DicomScan, FindsTheLowerCaseNamesOfACopiedMedium) {
    const TemporaryFolder folder;
    SyntheticSeries series;
    series.fileName = [](int k) { return fmt::format("im{}", k); };
    writeSeries(series, folder.path() / "pat");
    const fs::path directory = folder.path() / "dicomdir";
    writeDirectory(directory, {"PAT\\IM0", "PAT\\IM1", "PAT\\IM2", "PAT\\IM3"});
    EXPECT_TRUE(loadDicom({directory}));
}

TEST(DicomScan, TellsOfFilesThatADirectoryNamesInVain) {
    const TemporaryFolder folder;
    SyntheticSeries series;
    series.fileName = [](int k) { return fmt::format("IM{}", k); };
    writeSeries(series, folder.path() / "medium");
    // One that is missing, one outside the medium.
    series.fileName = [](int) { return "OUTSIDE"; };
    series.slices = 1;
    writeSeries(series, folder.path());
    const fs::path directory = folder.path() / "medium" / "DICOMDIR";
    writeDirectory(directory, {"IM0", "IM1", "IM2", "IM3", "IM4", "..\\OUTSIDE"});
    const auto volume = loadDicom({directory});
    ASSERT_TRUE(volume) << volume.error().text();
    ASSERT_EQ((*volume)->info().warnings.size(), 2u);
    EXPECT_THAT((*volume)->info().warnings[0].message,
                HasSubstr("IM4: the DICOMDIR names it, and it is not there"));
    EXPECT_THAT((*volume)->info().warnings[1].message, HasSubstr("OUTSIDE: the DICOMDIR names it"));
    EXPECT_EQ((*volume)->grid().size.z, 4);
}

TEST(DicomScan, IgnoresADirectoryFileFoundInAFolder) {
    const TemporaryFolder folder;
    writeSeries({}, folder.path());
    writeDirectory(folder.path() / "DICOMDIR", {"NOWHERE"});
    const auto volume = loadDicom({folder.path()});
    ASSERT_TRUE(volume) << volume.error().text();
    EXPECT_TRUE((*volume)->info().warnings.empty());
}

TEST(DicomScan, TellsWhenThereIsNothing) {
    const TemporaryFolder folder;
    const auto nothing = loadDicom({folder.path()});
    ASSERT_FALSE(nothing);
    EXPECT_EQ(nothing.error().code, ErrorCode::Unsupported);
    EXPECT_EQ(loadDicom({folder.path() / "absent"}).error().code, ErrorCode::NotFound);
    EXPECT_FALSE(loadDicom({}));
}

TEST(DicomScan, RecognisesDicomByContent) {
    const TemporaryFolder folder;
    const SyntheticFile slice = test::makeSlice({}, 0);
    slice.write(folder.path() / "with");
    EXPECT_TRUE(looksLikeDicom(folder.path() / "with"));
    for (const auto encoding : {test::DicomEncoding::ExplicitLittle, test::DicomEncoding::ImplicitLittle,
                                test::DicomEncoding::ExplicitBig}) {
        // Without preamble and meta information: from (0008,0016) on.
        const std::string whole = slice.encoded(encoding);
        const bool big = encoding == test::DicomEncoding::ExplicitBig;
        const std::size_t start =
            whole.find(big ? std::string("\x00\x08\x00\x16", 4) : std::string("\x08\x00\x16\x00", 4));
        const fs::path bare = folder.path() / "bare";
        writeText(bare, whole.substr(start));
        EXPECT_TRUE(looksLikeDicom(bare));
        EXPECT_TRUE(loadDicom({bare})) << loadDicom({bare}).error().text();
    }
    writeText(folder.path() / "text", "a text of more than 132 bytes " + std::string(200, 'x'));
    EXPECT_FALSE(looksLikeDicom(folder.path() / "text"));
    EXPECT_FALSE(looksLikeDicom(folder.path()));
    EXPECT_FALSE(looksLikeDicom(folder.path() / "absent"));
}

}  // namespace
}  // namespace pellucid::io
