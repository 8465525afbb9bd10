// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "scene/result.h"

namespace pellucid::io {

/// The skeleton of a DICOM file as its tags and lengths say, read without allocating anything the file asks
/// for. It comes before DCMTK sees a file: DCMTK descends into sequences by recursion without a limit (a file
/// of 200 kB with 10000 nested sequences overflows its stack) and reserves memory by the length an element
/// states.
struct DicomStructure {
    std::string transferSyntax;  ///< UID from the file meta information; empty when the file has none.
    std::uint64_t fileBytes = 0;
    std::uint64_t pixelBytes = 0;  ///< Bytes of pixel data there: the value, or all fragments but the offset
                                   ///< table; of a truncated value what is left of it.
    std::uint64_t pixelBytesStated = 0;  ///< What the file says of pixelBytes; more when it is truncated.
    bool hasPixelData = false;           ///< (7FE0,0010), or its float variants, at the top level.
};

/// Walks through all elements up to and including the pixel data. Truncated pixel data is no error here,
/// since only the header tells how many bytes are expected. Errors: NotFound, Unreadable; Corrupt: an element
/// goes past the end of the file, its sequence or its item (which, at which byte, expected and found bytes),
/// an unknown value representation, nesting deeper than 64; Unsupported: a transfer syntax whose layout is
/// not known; TooLarge: a deflated data set of more than 1 GiB when inflated.
[[nodiscard]] Result<DicomStructure> inspectDicom(const std::filesystem::path& file);

}  // namespace pellucid::io
