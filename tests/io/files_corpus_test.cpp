// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Real files of the optional corpus: what its README states of each.
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMetaImageReader.h>
#include <vtkNIFTIImageReader.h>
#include <vtkNew.h>
#include <vtkNrrdReader.h>
#include <vtkObject.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <type_traits>

#include "tests/io/load_expect.h"
#include "tests/support/corpus.h"

namespace pellucid::io {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

VolumePtr fromCorpus(const std::string& name) {
    return loaded(test::corpus() / name);
}

struct Known {
    const char* file;
    glm::ivec3 size;
    VoxelType type;
    int components;
    glm::dvec3 spacing;
    double lo;
    double hi;
};

void PrintTo(const Known& known, std::ostream* out) {
    *out << known.file;
}

class CorpusVolume : public testing::TestWithParam<Known> {};

/// Spacings and ranges as the README gives them, so to their last printed digit.
TEST_P(CorpusVolume, IsWhatTheReadmeSays) {
    const Known& known = GetParam();
    const auto volume = fromCorpus(known.file);
    ASSERT_TRUE(volume);
    EXPECT_EQ(volume->grid().size, known.size);
    EXPECT_EQ(volume->type(), known.type);
    EXPECT_EQ(volume->components(), known.components);
    const glm::dvec3 spacing = spacingMm(volume->grid());
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(spacing[axis], known.spacing[axis], 6e-4) << axis;
    EXPECT_NEAR(volume->physicalRange().lo, known.lo, 6e-3);
    EXPECT_NEAR(volume->physicalRange().hi, known.hi, 6e-3);
    EXPECT_EQ(volume->nonFiniteCount(), 0u);
}

constexpr Known kKnown[] = {
    {"volvis/bonsai.nii.gz", {256, 256, 256}, VoxelType::UInt8, 1, {1, 1, 1}, 0, 255},
    {"volvis/engine.nii.gz", {256, 256, 128}, VoxelType::UInt8, 1, {1, 1, 1}, 0, 255},
    {"volvis/fuel.nii.gz", {64, 33, 32}, VoxelType::UInt8, 1, {1, 1, 1}, 0, 255},
    {"volvis/tooth.nhdr", {103, 94, 161}, VoxelType::UInt16, 1, {1, 1, 1}, 0, 1300},
    {"volvis/head.120.vtk", {120, 120, 130}, VoxelType::UInt8, 1, {2.264, 2.264, 2.271}, 0, 255},
    {"volvis/heart.vti", {32, 32, 12}, VoxelType::Float32, 1, {1, 1, 4}, 0, 255},
    {"ct-torso-nifti/example_ct.nii.gz", {122, 101, 112}, VoxelType::Int32, 1, {3, 3, 3}, -1207, 3382},
    {"ct-aorta-nifti/ct_cropped.nii.gz", {120, 126, 164}, VoxelType::Int16, 1, {1.5, 1.5, 1.5}, -1078, 3343},
    {"mr-brain-stroke/T1.nii.gz", {124, 160, 140}, VoxelType::UInt8, 1, {1, 1, 1}, 0, 252},
    {"mr-brain-stroke/T2.nii.gz", {124, 160, 140}, VoxelType::UInt8, 1, {1, 1, 1}, 0, 503.969},
    {"mr-head-seg3d/MR.nii.gz", {160, 232, 160}, VoxelType::UInt8, 1, {1, 0.898437, 0.898437}, 0, 512},
    {"mr-macaque-inia19/inia19-t1-brain.nii.gz",
     {168, 206, 128},
     VoxelType::Float32,
     1,
     {0.5, 0.5, 0.5},
     0,
     383.176},
    {"mr-macaque-inia19/inia19-NeuroMaps.nii.gz",
     {168, 206, 128},
     VoxelType::Int16,
     1,
     {0.5, 0.5, 0.5},
     0,
     1605},
    {"time-series/isabel_f32_t02.vti",
     {125, 125, 25},
     VoxelType::Float32,
     1,
     {4.008, 4.008, 4.041},
     0,
     68.2455},
    {"multichannel/ct_perfusion.nii.gz", {256, 286, 15}, VoxelType::UInt8, 3, {0.78125, 0.78125, 10}, 0, 255},
    {"multichannel/V1.nii.gz", {84, 92, 56}, VoxelType::Float32, 3, {2.2, 2.2, 2.2}, -1, 1},
    {"multichannel/FA.nii.gz", {84, 92, 56}, VoxelType::Float32, 1, {2.2, 2.2, 2.2}, 0, 1.22474},
    {"orientation/shear.nii.gz", {306, 422, 54}, VoxelType::UInt8, 1, {0.482, 0.482, 2.371}, -1024, 789},
    {"orientation/AIL.nii.gz", {79, 67, 64}, VoxelType::UInt8, 1, {2.39, 2.3665, 2.385}, 0, 92.554},
    {"orientation/mha.mha", {64, 64, 37}, VoxelType::Int16, 1, {3.4375, 3.4375, 3.8}, 0, 6690},
    {"orientation/ras.hdr", {62, 41, 34}, VoxelType::UInt8, 1, {2.385, 2.39, 2.3665}, 0, 255},
    {"orientation/small_atlas_t1.nrrd", {60, 60, 47}, VoxelType::Int16, 1, {4, 4, 4}, 0, 339}};

INSTANTIATE_TEST_SUITE_P(Readme, CorpusVolume, testing::ValuesIn(kKnown));

/// Index of the voxel whose centre lies at the patient position; the fraction that is off it goes to `off`.
glm::ivec3 voxelAt(const Grid& grid, glm::dvec3 patient, double& off) {
    const glm::dvec3 index = transformPoint(indexFromPatient(grid), patient);
    const glm::dvec3 nearest = glm::round(index);
    off = std::max(off, glm::length(index - nearest));
    return glm::clamp(glm::ivec3(nearest), glm::ivec3(0), grid.size - 1);
}

/// Calls f(index) for every voxel.
template <class F>
void forVoxels(const Grid& grid, F&& f) {
    for (int k = 0; k < grid.size.z; ++k) {
        for (int j = 0; j < grid.size.y; ++j) {
            for (int i = 0; i < grid.size.x; ++i) f(glm::ivec3(i, j, k));
        }
    }
}

/// Largest difference of stored values at the same place in the patient.
double largestDifference(const Volume& a, const Volume& b, double& off) {
    double largest = 0.0;
    forVoxels(a.grid(), [&](glm::ivec3 index) {
        const glm::ivec3 other =
            voxelAt(b.grid(), transformPoint(a.grid().patientFromIndex, glm::dvec3(index)), off);
        largest = std::max(largest, std::abs(a.stored(index) - b.stored(other)));
    });
    return largest;
}

TEST(CorpusOrientation, OneVolumeInThreeOrientationsIsTheSameInThePatient) {
    const auto axial = fromCorpus("orientation/OrientImageTestAxial.nrrd");
    for (const char* name :
         {"orientation/OrientImageTestCoronal.nrrd", "orientation/OrientScalarVolumeTestSagittal.nrrd"}) {
        const auto other = fromCorpus(name);
        ASSERT_TRUE(axial && other);
        double off = 0.0;
        EXPECT_EQ(largestDifference(*axial, *other, off), 0.0) << name;
        EXPECT_LT(off, 1e-9);
    }
}

TEST(CorpusOrientation, NiftiAndNrrdOfOneScanAgreeInThePatient) {
    const auto nifti = fromCorpus("mr-brain-stroke/FLAIR.nii.gz");
    const auto nrrd = fromCorpus("mr-brain-stroke/FLAIR.nrrd");
    ASSERT_TRUE(nifti && nrrd);
    double off = 0.0;
    EXPECT_EQ(largestDifference(*nifti, *nrrd, off), 0.0);
    // The NIfTI's sform is float: entries of about 1 times 160 voxels, and an offset of about 100 mm: 2^-24 *
    // 420 mm.
    EXPECT_LT(off, 5e-5);
}

TEST(CorpusOrientation, MasksLieOnTheirMrInThePatientButNotByIndex) {
    const auto mr = fromCorpus("mr-head-seg3d/MR.nii.gz");
    const auto brain = fromCorpus("mr-head-seg3d/Brain.nrrd");
    ASSERT_TRUE(mr && brain);
    double off = 0.0;
    double count = 0.0;
    double darkByPlace = 0.0;
    double darkByIndex = 0.0;
    forVoxels(brain->grid(), [&](glm::ivec3 index) {
        if (brain->stored(index) == 0.0) return;
        const glm::ivec3 place =
            voxelAt(mr->grid(), transformPoint(brain->grid().patientFromIndex, glm::dvec3(index)), off);
        count += 1.0;
        darkByPlace += mr->physical(place) <= 60.0 ? 1.0 : 0.0;
        darkByIndex += mr->physical(index) <= 60.0 ? 1.0 : 0.0;
    });
    EXPECT_EQ(count, 1822964);
    EXPECT_LT(off, 1e-3);
    // Few voxels of a brain are as dark as air and bone: 1.2 per cent. Laid over by index, a part of the mask
    // falls outside the brain, and it is 3.9 per cent.
    EXPECT_LT(darkByPlace / count, 0.02);
    EXPECT_GT(darkByIndex / darkByPlace, 2.5);
}

TEST(CorpusOrientation, ShearIsKept) {
    const auto volume = fromCorpus("orientation/shear.nii.gz");
    ASSERT_TRUE(volume);
    EXPECT_TRUE(isSheared(volume->grid()));
    const glm::dvec3 j(volume->grid().patientFromIndex[1]);
    const glm::dvec3 k(volume->grid().patientFromIndex[2]);
    // srow_z[1] / |column| = 0.317305 of the file: the tilt of 18.5 degrees.
    EXPECT_NEAR(std::asin(glm::dot(glm::normalize(j), glm::normalize(k))) * 180.0 / M_PI, 18.5, 0.01);
    EXPECT_THAT(warningsOf(*volume), HasSubstr("disagree by up to 35.8 mm"));
}

TEST(CorpusTypes, EveryTypeGivesTheSameValues) {
    const auto reference = fromCorpus("pixel-types/AddTest_DOUBLE.mha");
    ASSERT_TRUE(reference);
    for (const char* type : {"SHORT", "USHORT", "INT", "UINT", "LONG", "ULONG", "FLOAT"}) {
        const auto volume = fromCorpus(std::string("pixel-types/AddTest_") + type + ".mha");
        ASSERT_TRUE(volume);
        double off = 0.0;
        EXPECT_EQ(largestDifference(*reference, *volume, off), 0.0) << type;
    }
    const auto brain = fromCorpus("pixel-types/FLOAT64.nii.gz");
    for (const char* type : {"UINT8", "INT16", "UINT16", "FLOAT32"}) {
        const auto volume = fromCorpus(std::string("pixel-types/") + type + ".nii.gz");
        ASSERT_TRUE(brain && volume);
        double largest = 0.0;
        forVoxels(brain->grid(), [&](glm::ivec3 index) {
            largest = std::max(largest, std::abs(brain->physical(index) - volume->physical(index)));
        });
        // Half a step of the coarsest quantisation: the slope of the uint8 file is 0.363.
        EXPECT_LE(largest, 0.5 * (std::string(type) == "UINT8" ? 0.36296 : 0.00283)) << type;
    }
}

/// Stored bytes as VTK's own reader has them.
template <class Reader>
void expectVtkAgrees(const fs::path& file, const Volume& volume) {
    vtkNew<Reader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    vtkDataArray* array = reader->GetOutput()->GetPointData()->GetScalars();
    ASSERT_NE(array, nullptr);
    const auto bytes = static_cast<std::size_t>(array->GetNumberOfValues() * array->GetDataTypeSize());
    ASSERT_EQ(bytes, volume.bytes().size());
    const auto* vtk = static_cast<const std::byte*>(array->GetVoidPointer(0));
    // vtkNIFTIImageReader turns the order of the slices round where qfac is -1.
    bool reversed = false;
    if constexpr (std::is_same_v<Reader, vtkNIFTIImageReader>) reversed = reader->GetQFac() < 0.0;
    const auto slices = static_cast<std::size_t>(volume.grid().size.z);
    const std::size_t slice = bytes / slices;
    for (std::size_t k = 0; k < slices; ++k) {
        const std::size_t from = reversed ? slices - 1 - k : k;
        ASSERT_EQ(std::memcmp(vtk + from * slice, volume.bytes().data() + k * slice, slice), 0)
            << "slice " << k;
    }
}

TEST(CorpusVoxels, AreTheOnesThatVtkReads) {
    vtkObject::GlobalWarningDisplayOff();
    int compared = 0;
    for (const auto& entry : fs::recursive_directory_iterator(test::corpus())) {
        const fs::path& file = entry.path();
        const std::string name = file.filename().string();
        // VTK reads MET_LONG beyond its buffer, and only the first plane of a vector.
        if (name.find("LONG") != std::string::npos || name == "V1.nii.gz") continue;
        const std::string extension = file.extension().string();
        const bool nifti = name.ends_with(".nii.gz") || extension == ".hdr";
        if (!nifti && extension != ".nrrd" && extension != ".nhdr" && extension != ".mha") continue;
        SCOPED_TRACE(name);
        const auto volume = loadVolume({file});
        if (!volume) continue;
        if (nifti)
            expectVtkAgrees<vtkNIFTIImageReader>(file, **volume);
        else if (extension == ".mha")
            expectVtkAgrees<vtkMetaImageReader>(file, **volume);
        else
            expectVtkAgrees<vtkNrrdReader>(file, **volume);
        ++compared;
    }
    EXPECT_GE(compared, 50);
}

TEST(CorpusRaw, HeadlessVoxelsAreReadByTheirLayout) {
    LoadOptions options;
    options.raw = RawLayout{};
    options.raw->size = {64, 64, 93};
    options.raw->type = "int16";
    options.raw->spacingMm = {3.2, 3.2, 1.5};
    const auto head = loaded(test::corpus() / "ct-head-64/CTHeadAxial.raw.gz", options);
    ASSERT_TRUE(head);
    EXPECT_EQ(head->storedRange(), (ValueRange{0, 3926}));
    options.raw->size = {64, 64, 94};
    EXPECT_THAT(refusal(test::corpus() / "ct-head-64/CTHeadAxial.raw.gz", options).text(),
                HasSubstr("found 761856 bytes"));
}

TEST(CorpusRefusals, SayWhatAndWhy) {
    const auto text = [](const std::string& name) { return refusal(test::corpus() / name).text(); };
    EXPECT_THAT(text("multichannel/complex.nii.gz"), HasSubstr("complex"));
    EXPECT_THAT(text("time-series/mpld_asl.nii.gz"), HasSubstr("4D, 25 time steps of 64x64x24: not yet"));
    EXPECT_THAT(text("grids/spx.vtk"), HasSubstr("UNSTRUCTURED_GRID"));
    EXPECT_THAT(text("volvis/tooth.raw"), HasSubstr("tooth.nhdr"));
    EXPECT_THAT(text("volvis/nut.slc"), HasSubstr("nut.slc.json"));
}

TEST(CorpusAll, EveryFileLoadsOrIsRefusedWithASentence) {
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(test::corpus())) {
        if (!entry.is_regular_file()) continue;
        ++files;
        const auto volume = loadVolume({entry.path()});
        if (volume) continue;
        const std::string text = volume.error().text();
        EXPECT_THAT(text, HasSubstr(entry.path().filename().string()));
        EXPECT_GT(text.size(), entry.path().string().size() + 15) << text;
        EXPECT_LT(text.size(), 1500u) << text;
        EXPECT_TRUE(std::all_of(text.begin(), text.end(), [](char c) {
            return c == '\n' || (c >= 0x20 && c < 0x7f);
        })) << text;
    }
    EXPECT_GT(files, 100);
}

}  // namespace
}  // namespace pellucid::io
