// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Byte offsets from nifti1.h (R. Cox, NIfTI-1.1) and nifti2.h.
#include "io/nifti_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <span>

#include "io/byte_order.h"
#include "io/text_scan.h"

namespace pellucid::io {
namespace {

constexpr std::int32_t kSize1 = 348;
constexpr std::int32_t kSize2 = 540;

/// sizeof_hdr, in either byte order; 0 when it is neither header's.
std::int32_t headerSize(std::span<const std::byte> bytes, bool& bigEndian) {
    if (bytes.size() < 4) return 0;
    for (const bool big : {false, true}) {
        const auto size = valueAt<std::int32_t>(bytes, 0, big);
        bigEndian = big;
        if (size == kSize1 || size == kSize2) return size;
    }
    return 0;
}

template <class Number, class To, std::size_t N>
void readArray(std::span<const std::byte> bytes, std::size_t offset, bool big, std::array<To, N>& to) {
    for (std::size_t i = 0; i < N; ++i)
        to[i] = static_cast<To>(valueAt<Number>(bytes, offset + i * sizeof(Number), big));
}

NiftiHeader readVersion1(std::span<const std::byte> b, bool big) {
    NiftiHeader h;
    h.version = 1;
    h.bigEndian = big;
    h.pair = std::to_integer<char>(b[345]) == 'i';
    readArray<std::int16_t>(b, 40, big, h.dim);
    h.intent = valueAt<std::int16_t>(b, 68, big);
    h.datatype = valueAt<std::int16_t>(b, 70, big);
    h.bitpix = valueAt<std::int16_t>(b, 72, big);
    readArray<float>(b, 76, big, h.pixdim);
    const float offset = valueAt<float>(b, 108, big);
    // Stored as float; beyond 2^53 or not a number it is refused as out of range later.
    h.voxOffset = offset >= 0.0f && offset < 9e15f ? static_cast<std::int64_t>(offset) : -1;
    h.slope = static_cast<double>(valueAt<float>(b, 112, big));
    h.inter = static_cast<double>(valueAt<float>(b, 116, big));
    h.units = std::to_integer<int>(b[123]);
    h.calMax = static_cast<double>(valueAt<float>(b, 124, big));
    h.calMin = static_cast<double>(valueAt<float>(b, 128, big));
    h.qformCode = valueAt<std::int16_t>(b, 252, big);
    h.sformCode = valueAt<std::int16_t>(b, 254, big);
    readArray<float>(b, 256, big, h.quatern);
    readArray<float>(b, 268, big, h.qoffset);
    readArray<float>(b, 280, big, h.srow);
    return h;
}

NiftiHeader readVersion2(std::span<const std::byte> b, bool big) {
    NiftiHeader h;
    h.version = 2;
    h.bigEndian = big;
    h.pair = std::to_integer<char>(b[5]) == 'i';
    h.datatype = valueAt<std::int16_t>(b, 12, big);
    h.bitpix = valueAt<std::int16_t>(b, 14, big);
    readArray<std::int64_t>(b, 16, big, h.dim);
    readArray<double>(b, 104, big, h.pixdim);
    h.voxOffset = valueAt<std::int64_t>(b, 168, big);
    h.slope = valueAt<double>(b, 176, big);
    h.inter = valueAt<double>(b, 184, big);
    h.calMax = valueAt<double>(b, 192, big);
    h.calMin = valueAt<double>(b, 200, big);
    h.qformCode = valueAt<std::int32_t>(b, 344, big);
    h.sformCode = valueAt<std::int32_t>(b, 348, big);
    readArray<double>(b, 352, big, h.quatern);
    readArray<double>(b, 376, big, h.qoffset);
    readArray<double>(b, 400, big, h.srow);
    h.units = valueAt<std::int32_t>(b, 500, big);
    h.intent = valueAt<std::int32_t>(b, 504, big);
    return h;
}

/// nifti1.h, METHOD 2: rotation from the quaternion, columns scaled by pixdim, the third also by qfac.
glm::dmat4 qform(const NiftiHeader& h) {
    const auto [b, c, d] = h.quatern;
    // Rounding may bring b^2 + c^2 + d^2 above 1; then a is 0 and the vector is normalised, as
    // nifti_quatern_to_mat44 does.
    double square = b * b + c * c + d * d;
    const double scale = square > 1.0 ? 1.0 / std::sqrt(square) : 1.0;
    const double x = b * scale;
    const double y = c * scale;
    const double z = d * scale;
    square = std::min(square, 1.0);
    const double a = std::sqrt(1.0 - square);
    const glm::dvec3 i(a * a + x * x - y * y - z * z, 2 * (x * y + a * z), 2 * (x * z - a * y));
    const glm::dvec3 j(2 * (x * y - a * z), a * a + y * y - x * x - z * z, 2 * (y * z + a * x));
    const glm::dvec3 k(2 * (x * z + a * y), 2 * (y * z - a * x), a * a + z * z - x * x - y * y);
    const double qfac = h.pixdim[0] < 0.0 ? -1.0 : 1.0;
    return {glm::dvec4(i * h.pixdim[1], 0.0), glm::dvec4(j * h.pixdim[2], 0.0),
            glm::dvec4(k * h.pixdim[3] * qfac, 0.0),
            glm::dvec4(h.qoffset[0], h.qoffset[1], h.qoffset[2], 1.0)};
}

/// nifti1.h, METHOD 3.
glm::dmat4 sform(const NiftiHeader& h) {
    glm::dmat4 matrix(1.0);
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column)
            matrix[column][row] = h.srow[static_cast<std::size_t>(row * 4 + column)];
    }
    return matrix;
}

double unitFactor(const NiftiHeader& header, std::vector<Warning>& warnings) {
    switch (header.units & 7) {
        case 0:
            return 1.0;  // unknown: mm by common use, and very common
        case 1:
            return 1000.0;
        case 2:
            return 1.0;
        case 3:
            return 1e-3;
        default:
            break;
    }
    warnings.push_back({fmt::format("the length unit code is {}; taken as mm", header.units & 7)});
    return 1.0;
}

double largestCornerDistance(const Grid& a, const Grid& b) {
    const auto cornersA = cornersMm(a);
    const auto cornersB = cornersMm(b);
    double largest = 0.0;
    for (std::size_t i = 0; i < cornersA.size(); ++i)
        largest = std::max(largest, glm::distance(cornersA[i], cornersB[i]));
    return largest;
}

}  // namespace

Result<NiftiHeader> parseNiftiHeader(std::string_view text) {
    const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(text.data()), text.size());
    bool big = false;
    const std::int32_t size = headerSize(bytes, big);
    if (size == 0)
        return fail(ErrorCode::Corrupt, "the first number is not the size of a NIfTI header (348 or 540)");
    if (bytes.size() < static_cast<std::size_t>(size)) {
        return fail(ErrorCode::Corrupt,
                    fmt::format("the header is cut off: expected {} bytes, found {}", size, bytes.size()));
    }
    const std::string_view magic = text.substr(size == kSize1 ? 344 : 4, 4);
    const std::string_view one = size == kSize1 ? "1" : "2";
    if ((magic[0] != 'n') || (magic[1] != '+' && magic[1] != 'i') || magic.substr(2, 1) != one) {
        return fail(ErrorCode::Unsupported,
                    "an ANALYZE 7.5 header, which does not state the orientation; NIfTI is read");
    }
    NiftiHeader header = size == kSize1 ? readVersion1(bytes, big) : readVersion2(bytes, big);
    if (header.dim[0] < 1 || header.dim[0] > 7)
        return fail(ErrorCode::Corrupt, fmt::format("dim[0] is {}; 1 to 7 is allowed", header.dim[0]));
    for (std::size_t i = 1; i < 8; ++i) {
        if (i > static_cast<std::size_t>(header.dim[0])) header.dim[i] = 1;
        // Axes beyond the third are often left 0 for "not there".
        if (i > 3 && header.dim[i] == 0) header.dim[i] = 1;
        if (header.dim[i] < 1 || header.dim[i] > INT32_MAX) {
            return fail(ErrorCode::Corrupt,
                        fmt::format("dim[{}] is {}; a positive integer is needed", i, header.dim[i]));
        }
    }
    return header;
}

Grid niftiGrid(const NiftiHeader& header, std::vector<Warning>& warnings) {
    const double unit = unitFactor(header, warnings);
    // RAS to LPS: x and y change sign.
    glm::dmat4 lpsFromRas(unit);
    lpsFromRas[0][0] = lpsFromRas[1][1] = -unit;
    lpsFromRas[3][3] = 1.0;
    Grid grid;
    grid.size = {static_cast<int>(header.dim[1]), static_cast<int>(header.dim[2]),
                 static_cast<int>(header.dim[3])};
    const Grid byQform{grid.size, lpsFromRas * qform(header)};
    const Grid bySform{grid.size, lpsFromRas * sform(header)};
    if (header.sformCode > 0) {
        // Impossible placements are refused by the caller; only possible ones can be compared.
        if (header.qformCode > 0 && validate(bySform) && validate(byQform)) {
            const double distance = largestCornerDistance(bySform, byQform);
            // Both are stored in float and the quaternion rounds: a tenth of a voxel is beyond that.
            if (!(distance < 0.1 * smallestSpacingMm(bySform))) {
                warnings.push_back({fmt::format(
                    "sform and qform disagree by up to {:.3g} mm at the corners; the sform is used",
                    distance)});
            }
        }
        return bySform;
    }
    if (header.qformCode > 0) return byQform;
    warnings.push_back(
        {"neither sform nor qform is given (both codes 0): the orientation is not stated; the axes are taken "
         "as right, "
         "anterior and superior"});
    glm::dmat4 scale(1.0);
    for (int axis = 0; axis < 3; ++axis) {
        const double spacing = std::abs(header.pixdim[static_cast<std::size_t>(axis) + 1]);
        scale[axis][axis] = spacing > 0.0 ? spacing : 1.0;
        if (!(spacing > 0.0))
            warnings.push_back({fmt::format("pixdim[{}] is not positive; taken as 1 mm", axis + 1)});
    }
    grid.patientFromIndex = lpsFromRas * scale;
    return grid;
}

}  // namespace pellucid::io
