// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "io/dicom_header.h"
#include "scene/volume.h"

namespace pellucid::io {

/// How the voxels of a series are kept: one type and mapping for all slices.
struct StoredForm {
    VoxelType type = VoxelType::Int16;
    bool physical =
        false;  ///< Voxels are float32 physical values, because slope or intercept differ between slices.
};

/// The smallest type that holds what all slices store: their own type when they agree, float32 physical
/// values when their rescale differs. Precondition: not empty.
[[nodiscard]] StoredForm storedForm(std::span<const SliceHeader> slices);

/// Decodes the pixels of one slice into `out` (columns x rows of form.type, row by row). Bits outside the
/// stored ones (overlays) are masked off, signed values extended from the high bit. Thread-safe for different
/// files. Errors: those of DicomDataset::open; Corrupt or Unreadable when the pixels cannot be decoded or are
/// not as many as the header says. Precondition: out has the size the header and the form ask for.
[[nodiscard]] Result<void> decodeSlice(const SliceHeader& slice, const StoredForm& form,
                                       std::span<std::byte> out);

}  // namespace pellucid::io
