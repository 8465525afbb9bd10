// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/dicom_pixels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "io/dicom_dataset.h"
#include "io/text_scan.h"

namespace pellucid::io {
namespace {

/// Decoded pixels as DCMTK holds them, in native byte order.
struct RawPixels {
    const std::byte* data = nullptr;
    std::uint64_t bytes = 0;
    PixelFormat format;
};

/// Decoders may change what the header says of the pixels, so the format is read again after them.
PixelFormat formatNow(DicomDataset& data, const PixelFormat& before) {
    const auto now = [&](const DcmTagKey& tag, int otherwise) {
        const auto value = data.number(tag);
        return value ? static_cast<int>(*value) : otherwise;
    };
    return {now(DCM_BitsAllocated, before.bitsAllocated), now(DCM_BitsStored, before.bitsStored),
            now(DCM_HighBit, before.highBit), now(DCM_PixelRepresentation, before.isSigned ? 1 : 0) == 1};
}

Result<RawPixels> decode(DicomDataset& data, const SliceHeader& slice) {
    const std::string& name = slice.placement.name;
    const bool bigEndian = data.dcmtk().getOriginalXfer() == EXS_BigEndianExplicit;
    if (bigEndian && slice.pixels.bitsAllocated == 32) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("{}: big-endian pixels of 32 bits have no settled byte order", name));
    }
    const OFCondition status = data.dcmtk().chooseRepresentation(EXS_LittleEndianExplicit, nullptr);
    DcmElement* element = nullptr;
    if (status.bad() || data.dcmtk().findAndGetElement(DCM_PixelData, element).bad() || element == nullptr) {
        return fail(ErrorCode::Corrupt,
                    fmt::format("{}: the {} pixel data cannot be decoded: {}", name, slice.transferSyntax,
                                status.bad() ? shown(status.text(), 200) : "there is none"));
    }
    RawPixels raw;
    raw.format = formatNow(data, slice.pixels);
    raw.bytes = element->getLength(EXS_LittleEndianExplicit);
    Uint16* words = nullptr;
    Uint8* bytes = nullptr;
    // Pixels of 16 and 32 bits lie in words, but some writers and decoders keep them as bytes.
    if (raw.format.bitsAllocated > 8 && element->getUint16Array(words).good() && words != nullptr) {
        raw.data = reinterpret_cast<const std::byte*>(words);
    } else if (element->getUint8Array(bytes).good() && bytes != nullptr) {
        raw.data = reinterpret_cast<const std::byte*>(bytes);
    } else {
        return fail(ErrorCode::Corrupt, fmt::format("{}: the pixel data cannot be read", name));
    }
    return raw;
}

Result<void> checkRaw(const RawPixels& raw, const SliceHeader& slice) {
    const PixelFormat& f = raw.format;
    const bool sound = (f.bitsAllocated == 8 || f.bitsAllocated == 16 || f.bitsAllocated == 32) &&
                       f.bitsStored >= 1 && f.highBit < f.bitsAllocated && f.highBit + 1 >= f.bitsStored &&
                       f.bitsAllocated <= slice.pixels.bitsAllocated && f.isSigned == slice.pixels.isSigned;
    if (!sound) {
        return fail(ErrorCode::Corrupt,
                    fmt::format("{}: the {} pixel data decodes to {} bits of {}, the header says {} of {}",
                                slice.placement.name, slice.transferSyntax, f.bitsStored, f.bitsAllocated,
                                slice.pixels.bitsStored, slice.pixels.bitsAllocated));
    }
    const std::uint64_t expected = slice.expectedPixelBytes /
                                   static_cast<std::uint64_t>(slice.pixels.bitsAllocated / 8) *
                                   static_cast<std::uint64_t>(f.bitsAllocated / 8);
    if (raw.bytes >= expected) return {};
    return fail(ErrorCode::Corrupt,
                fmt::format("{}: {} x {} pixels need {} bytes of pixel data, and {} were decoded",
                            slice.placement.name, slice.placement.size.x, slice.placement.size.y, expected,
                            raw.bytes));
}

/// Stored values out of their containers: `In` is the unsigned container type.
template <class In, class Out>
void convert(const RawPixels& raw, const SliceHeader& slice, bool physical, std::span<std::byte> out) {
    const int shift = raw.format.highBit + 1 - raw.format.bitsStored;
    const std::uint64_t mask = (1ull << raw.format.bitsStored) - 1;
    const std::uint64_t sign = raw.format.isSigned ? 1ull << (raw.format.bitsStored - 1) : 0;
    for (std::size_t i = 0; i < out.size() / sizeof(Out); ++i) {
        In container;
        std::memcpy(&container, raw.data + i * sizeof(In), sizeof(In));
        const std::uint64_t bits = (static_cast<std::uint64_t>(container) >> shift) & mask;
        // Flipping the sign bit and subtracting it extends it upwards.
        const auto value = static_cast<std::int64_t>(bits ^ sign) - static_cast<std::int64_t>(sign);
        const Out kept = physical
                             ? static_cast<Out>(static_cast<double>(value) * slice.slope + slice.intercept)
                             : static_cast<Out>(value);
        std::memcpy(out.data() + i * sizeof(Out), &kept, sizeof(Out));
    }
}

template <class Out>
void convertTo(const RawPixels& raw, const SliceHeader& slice, bool physical, std::span<std::byte> out) {
    switch (raw.format.bitsAllocated) {
        case 8:
            return convert<std::uint8_t, Out>(raw, slice, physical, out);
        case 16:
            return convert<std::uint16_t, Out>(raw, slice, physical, out);
        default:
            return convert<std::uint32_t, Out>(raw, slice, physical, out);
    }
}

}  // namespace

StoredForm storedForm(std::span<const SliceHeader> slices) {
    int bits = 0;
    bool anySigned = false;
    bool anyUnsigned = false;
    for (const SliceHeader& slice : slices) {
        if (slice.slope != slices.front().slope || slice.intercept != slices.front().intercept) {
            return {VoxelType::Float32, true};
        }
        anySigned = anySigned || slice.pixels.isSigned;
        anyUnsigned = anyUnsigned || !slice.pixels.isSigned;
        bits = std::max(bits, slice.pixels.bitsAllocated);
    }
    if (!anySigned)
        return {bits == 8 ? VoxelType::UInt8 : bits == 16 ? VoxelType::UInt16 : VoxelType::UInt32, false};
    // Signed and unsigned slices together need one more bit.
    if (anyUnsigned) bits *= 2;
    if (bits > 32) return {VoxelType::Float64, false};
    return {bits == 8 ? VoxelType::Int8 : bits == 16 ? VoxelType::Int16 : VoxelType::Int32, false};
}

Result<void> decodeSlice(const SliceHeader& slice, const StoredForm& form, std::span<std::byte> out) {
    auto data = DicomDataset::open(slice.file, DicomDataset::Part::All);
    if (!data) return tl::unexpected(data.error());
    try {
        const auto raw = decode(*data, slice);
        if (!raw) return tl::unexpected(raw.error());
        if (auto checked = checkRaw(*raw, slice); !checked) return checked;
        switch (form.type) {
            case VoxelType::Int8:
                convertTo<std::int8_t>(*raw, slice, form.physical, out);
                break;
            case VoxelType::UInt8:
                convertTo<std::uint8_t>(*raw, slice, form.physical, out);
                break;
            case VoxelType::Int16:
                convertTo<std::int16_t>(*raw, slice, form.physical, out);
                break;
            case VoxelType::UInt16:
                convertTo<std::uint16_t>(*raw, slice, form.physical, out);
                break;
            case VoxelType::Int32:
                convertTo<std::int32_t>(*raw, slice, form.physical, out);
                break;
            case VoxelType::UInt32:
                convertTo<std::uint32_t>(*raw, slice, form.physical, out);
                break;
            case VoxelType::Float32:
                convertTo<float>(*raw, slice, form.physical, out);
                break;
            case VoxelType::Float64:
                convertTo<double>(*raw, slice, form.physical, out);
                break;
        }
        return {};
    } catch (const std::exception& error) {
        return fail(ErrorCode::Unreadable, fmt::format("{}: {}", slice.placement.name, error.what()));
    }
}

}  // namespace pellucid::io
