// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/file_bytes.h"

#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace pellucid::test {
namespace {

namespace fs = std::filesystem;

std::string deflated(const std::string& bytes, int windowBits) {
    z_stream z{};
    deflateInit2(&z, Z_DEFAULT_COMPRESSION, Z_DEFLATED, windowBits, 8, Z_DEFAULT_STRATEGY);
    std::string result(deflateBound(&z, static_cast<uLong>(bytes.size())) + 64, '\0');
    z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    z.avail_in = static_cast<uInt>(bytes.size());
    z.next_out = reinterpret_cast<Bytef*>(result.data());
    z.avail_out = static_cast<uInt>(result.size());
    deflate(&z, Z_FINISH);
    result.resize(z.total_out);
    deflateEnd(&z);
    return result;
}

template <class T>
void put(std::string& bytes, std::size_t offset, double value, bool big) {
    const std::string raw = bytesOf<T>({static_cast<T>(value)}, big);
    bytes.replace(offset, raw.size(), raw);
}

std::string header1(const NiftiFile& f) {
    std::string b(f.pair ? 348 : 352, '\0');
    const bool big = f.bigEndian;
    put<std::int32_t>(b, 0, 348, big);
    for (std::size_t i = 0; i < 8; ++i) put<std::int16_t>(b, 40 + 2 * i, static_cast<double>(f.dim[i]), big);
    put<std::int16_t>(b, 68, f.intent, big);
    put<std::int16_t>(b, 70, f.datatype, big);
    put<std::int16_t>(b, 72, f.bitpix, big);
    for (std::size_t i = 0; i < 8; ++i) put<float>(b, 76 + 4 * i, f.pixdim[i], big);
    put<float>(b, 108, f.pair ? 0 : 352, big);
    put<float>(b, 112, f.slope, big);
    put<float>(b, 116, f.inter, big);
    b[123] = static_cast<char>(f.units);
    put<float>(b, 124, f.calMax, big);
    put<float>(b, 128, f.calMin, big);
    put<std::int16_t>(b, 252, f.qformCode, big);
    put<std::int16_t>(b, 254, f.sformCode, big);
    for (std::size_t i = 0; i < 6; ++i) put<float>(b, 256 + 4 * i, f.quatern[i], big);
    for (std::size_t i = 0; i < 12; ++i) put<float>(b, 280 + 4 * i, f.srow[i], big);
    b.replace(344, 4, f.pair ? std::string("ni1\0", 4) : std::string("n+1\0", 4));
    return b;
}

std::string header2(const NiftiFile& f) {
    std::string b(f.pair ? 540 : 544, '\0');
    const bool big = f.bigEndian;
    put<std::int32_t>(b, 0, 540, big);
    b.replace(4, 8, f.pair ? std::string("ni2\0\r\n\032\n", 8) : std::string("n+2\0\r\n\032\n", 8));
    put<std::int16_t>(b, 12, f.datatype, big);
    put<std::int16_t>(b, 14, f.bitpix, big);
    for (std::size_t i = 0; i < 8; ++i) put<std::int64_t>(b, 16 + 8 * i, static_cast<double>(f.dim[i]), big);
    for (std::size_t i = 0; i < 8; ++i) put<double>(b, 104 + 8 * i, f.pixdim[i], big);
    put<std::int64_t>(b, 168, f.pair ? 0 : 544, big);
    put<double>(b, 176, f.slope, big);
    put<double>(b, 184, f.inter, big);
    put<double>(b, 192, f.calMax, big);
    put<double>(b, 200, f.calMin, big);
    put<std::int32_t>(b, 344, f.qformCode, big);
    put<std::int32_t>(b, 348, f.sformCode, big);
    for (std::size_t i = 0; i < 6; ++i) put<double>(b, 352 + 8 * i, f.quatern[i], big);
    for (std::size_t i = 0; i < 12; ++i) put<double>(b, 400 + 8 * i, f.srow[i], big);
    put<std::int32_t>(b, 500, f.units, big);
    put<std::int32_t>(b, 504, f.intent, big);
    return b;
}

}  // namespace

TempFolder::TempFolder() {
    std::string pattern = (fs::temp_directory_path() / "pellucid-test-XXXXXX").string();
    m_path = ::mkdtemp(pattern.data());
}

TempFolder::~TempFolder() {
    std::error_code ignored;
    fs::remove_all(m_path, ignored);
}

fs::path TempFolder::write(const std::string& name, const std::string& bytes) const {
    const fs::path file = m_path / name;
    std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return file;
}

std::vector<std::string> TempFolder::names() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(m_path))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::string readBytes(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::string gzipped(const std::string& bytes) {
    return deflated(bytes, 15 + 16);
}

std::string zlibbed(const std::string& bytes) {
    return deflated(bytes, 15);
}

std::string NiftiFile::header() const {
    return version == 1 ? header1(*this) : header2(*this);
}

}  // namespace pellucid::test
