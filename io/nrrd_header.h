// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/voxel_data.h"

namespace pellucid::io {

/// The fields of an NRRD header as they stand, by their canonical lower-case names, and where the data
/// begins.
struct NrrdHeader {
    int version = 0;                            ///< 1..5
    std::map<std::string, std::string> fields;  ///< "space directions" -> "(1,0,0) (0,1,0) (0,0,1)"
    std::uint64_t bytes = 0;                    ///< Length of the header with its ending blank line.
    bool endsWithBlankLine = false;

    /// The field's text, empty when it is not there.
    [[nodiscard]] std::string_view field(const std::string& name) const;
};

/// Errors: Corrupt naming the line.
[[nodiscard]] Result<NrrdHeader> parseNrrdHeader(std::string_view text);

/// The axes of an NRRD sorted into three of space and at most one of components.
struct NrrdAxes {
    std::vector<int> sizes;  ///< All axes, fastest first.
    std::vector<int> space;  ///< Two or three indices into sizes.
    int componentAxis = -1;  ///< -1: none; else the first or the last axis.
    int components = 1;
};

/// Errors: Corrupt, Unsupported (more than three space axes, components in the middle, complex numbers).
[[nodiscard]] Result<NrrdAxes> nrrdAxes(const NrrdHeader& header);

/// Placement of the samples in the patient frame. Warns where the header does not state an orientation.
[[nodiscard]] Result<Grid> nrrdGrid(const NrrdHeader& header, const NrrdAxes& axes,
                                    std::vector<Warning>& warnings);

}  // namespace pellucid::io
