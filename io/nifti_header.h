// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "io/voxel_data.h"

namespace pellucid::io {

/// The members of a NIfTI-1 or NIfTI-2 header that decide placement and values, in native numbers.
struct NiftiHeader {
    int version = 1;
    bool bigEndian = false;
    bool pair = false;                  ///< Voxels in a .img file of their own.
    std::array<std::int64_t, 8> dim{};  ///< dim[0]: how many; dim[1..7].
    std::array<double, 8> pixdim{};     ///< pixdim[0]: qfac.
    int intent = 0;
    int datatype = 0;
    int bitpix = 0;
    std::int64_t voxOffset = 0;
    double slope = 0.0;
    double inter = 0.0;
    double calMax = 0.0;
    double calMin = 0.0;
    int units = 0;  ///< xyzt_units
    int qformCode = 0;
    int sformCode = 0;
    std::array<double, 3> quatern{};  ///< b, c, d
    std::array<double, 3> qoffset{};
    std::array<double, 12> srow{};  ///< srow_x, srow_y, srow_z
};

/// Errors: Corrupt (cut off, dim outside 1..7, sizes), Unsupported (ANALYZE 7.5 without the NIfTI magic).
[[nodiscard]] Result<NiftiHeader> parseNiftiHeader(std::string_view bytes);

/// Placement in LPS mm: sform where its code is positive, else qform, else pixdim without an orientation
/// (warned). NIfTI's own frame is RAS (nifti1.h, "3D IMAGE (VOLUME) ORIENTATION AND LOCATION IN SPACE").
[[nodiscard]] Grid niftiGrid(const NiftiHeader& header, std::vector<Warning>& warnings);

}  // namespace pellucid::io
