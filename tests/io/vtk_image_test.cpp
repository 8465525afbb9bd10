// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// VTI and legacy VTK, written by VTK's writers or by hand.
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkShortArray.h>
#include <vtkXMLImageDataWriter.h>

#include "tests/io/load_expect.h"

namespace pellucid::io {
namespace {

using test::bytesOf;
using test::ramp;
using testing::HasSubstr;

/// 4x3x2 int16, its extent not from 0, turned: i to +y, j to -x.
vtkSmartPointer<vtkImageData> turnedImage() {
    const auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetExtent(1, 4, 0, 2, -1, 0);
    image->SetSpacing(2, 3, 4);
    image->SetOrigin(10, 20, 30);
    image->SetDirectionMatrix(0, -1, 0, 1, 0, 0, 0, 0, 1);
    vtkNew<vtkShortArray> values;
    values->SetName("v");
    for (const std::int16_t value : ramp<std::int16_t>(24)) values->InsertNextValue(value);
    image->GetPointData()->SetScalars(values);
    return image;
}

std::filesystem::path writeVti(const test::TempFolder& folder, const std::string& name, vtkImageData* image,
                               int mode, bool compressed) {
    const auto file = folder.path() / name;
    vtkNew<vtkXMLImageDataWriter> writer;
    writer->SetFileName(file.c_str());
    writer->SetInputData(image);
    writer->SetDataMode(mode);
    if (!compressed) writer->SetCompressorTypeToNone();
    writer->Write();
    return file;
}

TEST(Vti, DirectionExtentAndValuesInEveryEncoding) {
    const test::TempFolder folder;
    for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended}) {
        for (const bool compressed : {false, true}) {
            SCOPED_TRACE(std::to_string(mode) + (compressed ? " compressed" : " plain"));
            const auto volume = loaded(writeVti(folder, "a.vti", turnedImage(), mode, compressed));
            ASSERT_TRUE(volume);
            EXPECT_EQ(volume->grid().size, glm::ivec3(4, 3, 2));
            // The first voxel has index (1, 0, -1): 2 mm along i (+y), -4 mm along k from the origin.
            expectPlaced(volume->grid(), {{0, 2, 0, 0}, {-3, 0, 0, 0}, {0, 0, 4, 0}, {10, 22, 26, 1}}, 0.0);
            expectVoxels(*volume, ramp<std::int16_t>(24));
            EXPECT_THAT(warningsOf(*volume), HasSubstr("no patient orientation"));
        }
    }
}

TEST(Vti, OfSeveralArraysTheActiveOneIsShownAndSaid) {
    const test::TempFolder folder;
    const auto image = turnedImage();
    vtkNew<vtkDoubleArray> other;
    other->SetName("a");
    for (int i = 0; i < 24; ++i) other->InsertNextValue(0.5 * i);
    image->GetPointData()->AddArray(other);
    const auto volume = loaded(writeVti(folder, "a.vti", image, vtkXMLWriter::Appended, true));
    ASSERT_TRUE(volume);
    expectVoxels(*volume, ramp<std::int16_t>(24));
    EXPECT_THAT(warningsOf(*volume), HasSubstr("holds 2 arrays"));
}

TEST(Vti, CellDataLieBetweenThePoints) {
    const test::TempFolder folder;
    const auto volume = loaded(folder.write(
        "a.vti",
        R"(<VTKFile type="ImageData"><ImageData WholeExtent="0 2 0 1 0 1" Origin="0 0 0" Spacing="1 1 1"><Piece Extent="0 2 0 1 0 1">
        <CellData Scalars="c"><DataArray type="UInt8" Name="c" format="ascii">7 9</DataArray></CellData></Piece></ImageData></VTKFile>)"));
    ASSERT_TRUE(volume);
    EXPECT_EQ(volume->grid().size, glm::ivec3(2, 1, 1));
    EXPECT_EQ(volume->grid().patientFromIndex[3], glm::dvec4(0.5, 0.5, 0.5, 1));
    expectVoxels<std::uint8_t>(*volume, {7, 9});
}

TEST(Vti, WhatIsCutOffOrTooSmallIsRefused) {
    const test::TempFolder folder;
    for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended}) {
        const std::string whole =
            test::readBytes(writeVti(folder, "a.vti", turnedImage(), mode, mode != vtkXMLWriter::Ascii));
        int wholeOnes = 0;
        for (std::size_t length = 0; length < whole.size(); length += 7) {
            const auto volume = loadVolume({folder.write("cut.vti", whole.substr(0, length))});
            if (!volume) continue;
            // Only closing tags are missing: then every voxel must be there.
            expectVoxels(**volume, ramp<std::int16_t>(24));
            ++wholeOnes;
        }
        EXPECT_LE(wholeOnes, 8);
    }
    const auto sized = [&](const std::string& extent, const std::string& values) {
        return folder.write("b.vti", R"(<VTKFile type="ImageData"><ImageData WholeExtent=")" + extent +
                                         R"(" Origin="0 0 0" Spacing="1 1 1"><Piece Extent=")" + extent +
                                         R"("><PointData><DataArray type="Int32" Name="c" format="ascii">)" +
                                         values + "</DataArray></PointData></Piece></ImageData></VTKFile>");
    };
    EXPECT_TRUE(loaded(sized("0 1 0 1 0 0", "1 2 3 4")));
    expectRefused(sized("0 1 0 1 0 0", "1 2 3"), ErrorCode::Corrupt, {});
    expectRefused(sized("0 999 0 999 0 999", "1 2 3"), ErrorCode::Corrupt, {"1000x1000x1000"});
    expectRefused(sized("0 2000000 0 2000000 0 2000000", "1"), ErrorCode::TooLarge,
                  {"2000001x2000001x2000001"});
    expectRefused(sized("0 -1 0 1 0 1", "1"), ErrorCode::Corrupt, {"WholeExtent"});
    expectRefused(folder.write("c.vtu", "<VTKFile type=\"UnstructuredGrid\"></VTKFile>"),
                  ErrorCode::Unsupported, {"UnstructuredGrid"});
}

const std::string kLegacy =
    "# vtk DataFile Version 3.0\n\nBINARY\nDATASET STRUCTURED_POINTS\nDIMENSIONS 4 3 2\nORIGIN 10 20 "
    "30\nSPACING 2 3 4\n";

std::string ascii(std::string text) {
    return text.replace(text.find("BINARY"), 6, "ASCII");
}

template <class T>
std::string numbers(const std::vector<T>& values) {
    std::string text;
    for (const T value : values) text += std::to_string(value) + " ";
    return text;
}

TEST(LegacyVtk, BinaryTextAndFieldAgree) {
    const test::TempFolder folder;
    const auto values = ramp<std::int16_t>(24);
    const std::string scalars = "POINT_DATA 24\nSCALARS v short\nLOOKUP_TABLE default\n";
    for (const auto& file : {folder.write("a.vtk", kLegacy + scalars + bytesOf(values, true)),
                             folder.write("b.vtk", ascii(kLegacy) + scalars + numbers(values)),
                             folder.write("c.vtk", kLegacy + "POINT_DATA 24\nFIELD f 1\nv 1 24 short\n" +
                                                       bytesOf(values, true))}) {
        SCOPED_TRACE(file.filename());
        const auto volume = loaded(file);
        ASSERT_TRUE(volume);
        expectPlaced(volume->grid(), {{2, 0, 0, 0}, {0, 3, 0, 0}, {0, 0, 4, 0}, {10, 20, 30, 1}}, 0.0);
        expectVoxels(*volume, values);
    }
    const auto vectors = loaded(
        folder.write("d.vtk", kLegacy + "POINT_DATA 24\nVECTORS v float\n" + bytesOf(ramp<float>(72), true)));
    ASSERT_TRUE(vectors);
    EXPECT_EQ(vectors->components(), 3);
    expectVoxels(*vectors, ramp<float>(72));
}

TEST(LegacyVtk, RefusalsSayWhatAndWhere) {
    const test::TempFolder folder;
    const std::string scalars = "POINT_DATA 24\nSCALARS v short 1\nLOOKUP_TABLE default\n";
    const std::string voxels = bytesOf(ramp<std::int16_t>(24), true);
    const auto file = [&](const std::string& text) { return folder.write("a.vtk", text); };
    expectRefused(file(kLegacy + scalars + voxels.substr(0, 47)), ErrorCode::Corrupt,
                  {"= 48 bytes", "found 47 bytes"});
    expectRefused(file(ascii(kLegacy) + scalars + "1 2 3 4 5"), ErrorCode::Corrupt,
                  {"expected 24 numbers, found 5"});
    expectRefused(file(ascii(kLegacy) + scalars + "1 2 x 4 5"), ErrorCode::Corrupt, {"found 2"});
    expectRefused(file(kLegacy + "POINT_DATA 25\nSCALARS v short\n"), ErrorCode::Corrupt,
                  {"25", "4x3x2 = 24"});
    expectRefused(file(kLegacy + "POINT_DATA 24\nSCALARS v bit\n"), ErrorCode::Unsupported, {"bit"});
    expectRefused(file(kLegacy + "POINT_DATA 24\nTENSORS t float\n"), ErrorCode::Unsupported, {"tensors"});
    expectRefused(file(kLegacy), ErrorCode::Corrupt, {"cut off"});
    expectRefused(file("# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n"), ErrorCode::Unsupported,
                  {"POLYDATA"});
    std::string huge = kLegacy + scalars;
    huge.replace(huge.find("4 3 2"), 5, "900000 900000 900000");
    expectRefused(file(huge), ErrorCode::TooLarge, {"900000"});
}

}  // namespace
}  // namespace pellucid::io
