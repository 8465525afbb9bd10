// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// One reader for each file format; load.cpp decides which. Each takes a regular file whose content or name
// says it is of that format. Private to io.
//
// Why NRRD, MetaImage and NIfTI are parsed here and not by VTK's readers (VTK 9.1, measured on real and
// damaged files):
//  - vtkNrrdReader and vtkMetaImageReader deliver an identity direction for every file: `space directions`
//  and
//    `TransformMatrix` are lost, so a sagittal volume would be drawn as axial.
//  - vtkNIFTIImageReader splits a sheared sform into spacing and a matrix, turns the order of the slices
//  round
//    where qfac is -1, and shows the first of several time steps.
//  - A truncated file (raw, gzip or zlib) loads with the missing voxels zero; vtkNrrdReader (raw) and
//    vtkMetaImageReader report no error at all, MetaIO prints to standard output instead.
//  - MET_LONG and MET_ULONG, 4 bytes in a file, are read as 8-byte long: past the end of the buffer.
//  - A header that states 800 GB ends the program with bad_alloc.
// VTI and legacy VTK files go through VTK's readers, after a check of their sizes.
#pragma once

#include "io/voxel_data.h"

namespace pellucid::io {

/// NRRD 1 to 5 (Teem, "Definition of NRRD File Format"): attached and detached, raw and gzip.
[[nodiscard]] Result<VolumePtr> loadNrrd(const std::filesystem::path& file, const LoadOptions& options);
/// MetaImage (.mha, .mhd with .raw or .zraw).
[[nodiscard]] Result<VolumePtr> loadMetaImage(const std::filesystem::path& file, const LoadOptions& options);
/// NIfTI-1 and NIfTI-2: .nii, .nii.gz, or the header of a .hdr/.img pair.
[[nodiscard]] Result<VolumePtr> loadNifti(const std::filesystem::path& file, const LoadOptions& options);
/// VTK XML image data (.vti).
[[nodiscard]] Result<VolumePtr> loadVti(const std::filesystem::path& file, const LoadOptions& options);
/// Legacy VTK structured points (.vtk).
[[nodiscard]] Result<VolumePtr> loadLegacyVtk(const std::filesystem::path& file, const LoadOptions& options);

/// Raw voxels, plain or gzip, laid out as told.
[[nodiscard]] Result<VolumePtr> loadRaw(const std::filesystem::path& file, const RawLayout& layout,
                                        const LoadOptions& options);
/// The sidecar of a raw file, if there is one: FILE.json, or FILE with its extension replaced by .json.
[[nodiscard]] std::optional<std::filesystem::path> rawSidecar(const std::filesystem::path& file);
/// Errors: Corrupt (not JSON: line and column), InvalidArgument (JSON pointer, what was found, what is
/// allowed).
[[nodiscard]] Result<RawLayout> readRawSidecar(const std::filesystem::path& sidecar);

/// True for the first bytes (decompressed) of a NIfTI-1 or NIfTI-2 header.
[[nodiscard]] bool looksLikeNifti(std::string_view start);
/// True for text whose first key is one of MetaImage's.
[[nodiscard]] bool looksLikeMetaImage(std::string_view start);

}  // namespace pellucid::io
