// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/vtk_reading.h"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkMatrix4x4.h>
#include <vtkPointData.h>

#include <cstring>
#include <glm/ext/matrix_transform.hpp>
#include <optional>
#include <type_traits>

#include "io/byte_order.h"
#include "io/text_scan.h"

namespace pellucid::io {
namespace {

std::optional<StoredType> storedType(int vtkType) {
    constexpr bool kLongIsWide = sizeof(long) == 8;
    switch (vtkType) {
        case VTK_CHAR:
            return std::is_signed_v<char> ? StoredType::Int8 : StoredType::UInt8;
        case VTK_SIGNED_CHAR:
            return StoredType::Int8;
        case VTK_UNSIGNED_CHAR:
            return StoredType::UInt8;
        case VTK_SHORT:
            return StoredType::Int16;
        case VTK_UNSIGNED_SHORT:
            return StoredType::UInt16;
        case VTK_INT:
            return StoredType::Int32;
        case VTK_UNSIGNED_INT:
            return StoredType::UInt32;
        case VTK_LONG:
            return kLongIsWide ? StoredType::Int64 : StoredType::Int32;
        case VTK_UNSIGNED_LONG:
            return kLongIsWide ? StoredType::UInt64 : StoredType::UInt32;
        case VTK_LONG_LONG:
            return StoredType::Int64;
        case VTK_UNSIGNED_LONG_LONG:
            return StoredType::UInt64;
        case VTK_ID_TYPE:
            return sizeof(vtkIdType) == 8 ? StoredType::Int64 : StoredType::Int32;
        case VTK_FLOAT:
            return StoredType::Float32;
        case VTK_DOUBLE:
            return StoredType::Float64;
        default:
            return std::nullopt;
    }
}

vtkDataArray* firstArray(vtkDataSetAttributes* data) {
    if (vtkDataArray* scalars = data->GetScalars()) return scalars;
    if (vtkDataArray* vectors = data->GetVectors()) return vectors;
    for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
        if (vtkDataArray* array = data->GetArray(i)) return array;
    }
    return nullptr;
}

/// Index (0, 0, 0) of a volume is the first point of the extent, or the middle of its first cell.
Grid gridOf(vtkImageData& image, bool cells) {
    const int* extent = image.GetExtent();
    Grid grid;
    glm::dvec3 first(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        const int points = extent[2 * axis + 1] - extent[2 * axis] + 1;
        grid.size[axis] = cells && points > 1 ? points - 1 : points;
        first[axis] = extent[2 * axis] + (cells && points > 1 ? 0.5 : 0.0);
    }
    const double* m = image.GetIndexToPhysicalMatrix()->GetData();
    glm::dmat4 physicalFromIndex(1.0);
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) physicalFromIndex[column][row] = m[4 * row + column];
    }
    grid.patientFromIndex = glm::translate(physicalFromIndex, first);
    return grid;
}

}  // namespace

void VtkErrors::Execute(vtkObject* /*caller*/, unsigned long /*event*/, void* data) {
    if (!any())
        m_first = data != nullptr ? shown(trimmed(static_cast<const char*>(data)), 300) : "unknown error";
}

void silenceVtk() {
    vtkObject::GlobalWarningDisplayOff();
}

Result<VolumePtr> volumeFromVtk(vtkImageData& image, VolumeParts parts) {
    vtkDataArray* array = firstArray(image.GetPointData());
    const bool cells = array == nullptr;
    if (cells) array = firstArray(image.GetCellData());
    if (array == nullptr)
        return fail(
            ErrorCode::Corrupt,
            "the file holds no voxels that could be read: it has no point or cell data, or is damaged");
    const auto type = storedType(array->GetDataType());
    if (!type)
        return fail(ErrorCode::Unsupported,
                    fmt::format("the voxel type is {}; numbers of 8 bits and more are read",
                                array->GetDataTypeAsString()));
    if (array->GetNumberOfComponents() > 4) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("{} components a voxel; 1 to 4 are drawn", array->GetNumberOfComponents()));
    }
    parts.type = *type;
    parts.components = array->GetNumberOfComponents();
    parts.bigEndian = kNativeIsBig;
    parts.grid = gridOf(image, cells);
    const auto wanted = voxelBytes(parts.grid.size, parts.components, *type, UINT64_MAX);
    if (!wanted) return tl::unexpected(wanted.error());
    const std::uint64_t found =
        static_cast<std::uint64_t>(array->GetNumberOfValues()) * bytesPerComponent(*type);
    if (found != *wanted) {
        return fail(ErrorCode::Corrupt,
                    fmt::format("expected {} = {} bytes of voxels, found {}",
                                arithmetic(parts.grid.size, parts.components, *type), *wanted, found));
    }
    parts.voxels.resize(*wanted);
    std::memcpy(parts.voxels.data(), array->GetVoidPointer(0), *wanted);
    parts.info.warnings.push_back(
        {"VTK files state no patient orientation; the axes are taken as left, posterior and superior, in "
         "mm"});
    return assemble(std::move(parts));
}

}  // namespace pellucid::io
