// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Damaged files of every format: each must load or be refused with a sentence, in bounded time and memory.
// The damage is the same at every run: std::mt19937 is specified exactly and its numbers are used without a
// distribution.
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkShortArray.h>
#include <vtkXMLImageDataWriter.h>

#include <algorithm>
#include <array>
#include <random>

#include "tests/io/load_expect.h"

namespace pellucid::io {
namespace {

using test::bytesOf;
using test::gzipped;
using test::NiftiFile;
using test::ramp;

struct Seed {
    std::string name;
    std::string bytes;
};

std::string vti(const test::TempFolder& folder, int mode, bool compressed) {
    vtkNew<vtkImageData> image;
    image->SetDimensions(4, 3, 2);
    vtkNew<vtkShortArray> values;
    values->SetName("v");
    for (const std::int16_t value : ramp<std::int16_t>(24)) values->InsertNextValue(value);
    image->GetPointData()->SetScalars(values);
    const auto file = folder.path() / "seed.vti";
    vtkNew<vtkXMLImageDataWriter> writer;
    writer->SetFileName(file.c_str());
    writer->SetInputData(image);
    writer->SetDataMode(mode);
    if (!compressed) writer->SetCompressorTypeToNone();
    writer->Write();
    return test::readBytes(file);
}

std::vector<Seed> seeds(const test::TempFolder& folder) {
    const std::string voxels = bytesOf(ramp<std::int16_t>(24));
    const std::string nrrd =
        "NRRD0005\ntype: short\ndimension: 4\nsizes: 1 4 3 2\nkinds: vector domain domain domain\nendian: "
        "little\n"
        "space: right-anterior-superior\nspace units: \"mm\" \"mm\" \"cm\"\nspace directions: none "
        "(2,0,0.25) (0.5,0,-3) (0,4,1)\n"
        "space origin: (10,-20,30)\nbyte skip: 0\n";
    const std::string plain =
        "NRRD0001\ntype: float\ndimension: 3\nsizes: 3 2 1\nspacings: 1 nan 2\naxis mins: 0 0 0\naxis maxs: "
        "3 3 3\n"
        "centerings: cell node cell\nendian: big\nencoding: raw\n\n";
    const std::string meta =
        "ObjectType = Image\nNDims = 3\nBinaryData = True\nDimSize = 4 3 2\nTransformMatrix = 0 1 0 0 0 -1 "
        "-1 0 0\n"
        "Offset = 10 -20 30\nElementSpacing = 2 3 4\nElementType = MET_SHORT\n";
    const std::string legacy =
        "DATASET STRUCTURED_POINTS\nDIMENSIONS 4 3 2\nORIGIN 0 0 0\nSPACING 1 2 3\nPOINT_DATA 24\n";
    NiftiFile one;
    NiftiFile two;
    two.version = 2;
    two.bigEndian = true;
    one.qformCode = 1;
    std::string text;
    for (int i = 0; i < 24; ++i) text += std::to_string(i) + " ";
    return {
        {"a.nrrd", nrrd + "encoding: raw\n\n" + voxels},
        {"b.nrrd", nrrd + "encoding: gzip\n\n" + gzipped(voxels)},
        {"c.nrrd", plain + bytesOf(ramp<float>(6), true)},
        {"d.nhdr", plain.substr(0, plain.size() - 1) + "data file: d.raw\n"},
        {"e.mha", meta + "ElementDataFile = LOCAL\n" + voxels},
        {"f.mha", meta + "CompressedData = True\nElementDataFile = LOCAL\n" + test::zlibbed(voxels)},
        {"g.nii", one.file(voxels)},
        {"h.nii.gz", gzipped(one.file(voxels))},
        {"i.nii", two.file(bytesOf(ramp<std::int16_t>(24), true))},
        {"j.vti", vti(folder, vtkXMLWriter::Ascii, false)},
        {"k.vti", vti(folder, vtkXMLWriter::Binary, true)},
        {"l.vti", vti(folder, vtkXMLWriter::Appended, true)},
        {"m.vti", vti(folder, vtkXMLWriter::Appended, false)},
        {"n.vtk", "# vtk DataFile Version 3.0\nt\nBINARY\n" + legacy +
                      "SCALARS v short\nLOOKUP_TABLE default\n" + bytesOf(ramp<std::int16_t>(24), true)},
        {"o.vtk", "# vtk DataFile Version 3.0\nt\nASCII\n" + legacy + "FIELD f 2\nv 1 24 int\n" + text +
                      "\nw 1 24 float\n" + text},
        {"p.raw.json",
         R"({"size": [4, 3, 2], "type": "int16", "headerBytes": 0, "spacingMm": [1, 2, 3], "slope": 0.5})"}};
}

/// One to eight random changes: bytes, digits, a cut, a repeated piece, a piece taken out.
std::string damaged(std::string bytes, std::mt19937& random) {
    constexpr std::array<std::string_view, 8> kTokens{"-1",    "99999999999999999999", "nan", "0",
                                                      "1e308", "4294967295",           "\n",  "\""};
    for (unsigned changes = 1 + random() % 8; changes > 0 && !bytes.empty(); --changes) {
        const std::size_t at = random() % bytes.size();
        const std::size_t length = random() % 16;
        switch (random() % 8) {
            case 0:
                bytes.resize(at);
                break;
            case 1:
                bytes.insert(at, bytes.substr(at, length));
                break;
            case 2:
                bytes.erase(at, length);
                break;
            case 3:
                bytes.insert(at, kTokens[random() % kTokens.size()]);
                break;
            case 4: {
                const std::size_t digit = bytes.find_first_of("0123456789", at);
                if (digit != std::string::npos) bytes[digit] = static_cast<char>('0' + random() % 10);
                break;
            }
            default:
                bytes[at] = static_cast<char>(random() % 256);
                break;
        }
    }
    return bytes;
}

TEST(HostileFiles, AreLoadedOrRefusedWithASentence) {
    const test::TempFolder folder;
    const std::vector<Seed> all = seeds(folder);
    folder.write("d.raw", bytesOf(ramp<float>(6), true));
    folder.write("p.raw", bytesOf(ramp<std::int16_t>(24)));
    LoadOptions options;
    options.maxVoxelBytes = 64 << 20;
    std::mt19937 random(20240611);
    int refused = 0;
    for (int run = 0; run < 2400; ++run) {
        const Seed& seed = all[static_cast<std::size_t>(run) % all.size()];
        folder.write(seed.name, damaged(seed.bytes, random));
        // A sidecar is read with its voxels.
        const bool sidecar = seed.name.ends_with(".json");
        const auto file = folder.path() / (sidecar ? seed.name.substr(0, seed.name.size() - 5) : seed.name);
        const auto volume = loadVolume({file}, options);
        if (volume) {
            EXPECT_EQ((*volume)->bytes().size(), (*volume)->voxelCount() *
                                                     bytesPerComponent((*volume)->type()) *
                                                     static_cast<unsigned>((*volume)->components()));
            EXPECT_TRUE(validate((*volume)->grid()));
            continue;
        }
        ++refused;
        const std::string text = volume.error().text();
        EXPECT_GT(text.size(), 20u) << text;
        EXPECT_TRUE(std::all_of(text.begin(), text.end(), [](char c) { return c >= 0x20 && c < 0x7f; }))
            << "run " << run << ": " << text;
    }
    // Whatever the damage does, most of it must be noticed.
    EXPECT_GT(refused, 1200);
}

TEST(HostileFiles, UndamagedSeedsLoad) {
    const test::TempFolder folder;
    const std::vector<Seed> all = seeds(folder);
    for (const Seed& seed : all) folder.write(seed.name, seed.bytes);
    folder.write("d.raw", bytesOf(ramp<float>(6), true));
    folder.write("p.raw", bytesOf(ramp<std::int16_t>(24)));
    for (const Seed& seed : all) {
        EXPECT_TRUE(loaded(folder.path() / (seed.name.ends_with(".json") ? "p.raw" : seed.name)))
            << seed.name;
    }
}

}  // namespace
}  // namespace pellucid::io
