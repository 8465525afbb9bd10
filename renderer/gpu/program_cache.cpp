// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gpu/program_cache.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>

namespace pellucid::renderer {

namespace {

constexpr char kMagic[8] = {'P', 'E', 'L', 'P', 'R', 'O', 'G', '1'};

std::filesystem::path cacheFolder() {
    if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg != nullptr && *xdg != '\0')
        return std::filesystem::path(xdg) / "pellucid" / "programs";
    if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
        return std::filesystem::path(home) / ".cache" / "pellucid" / "programs";
    return {};
}

/// FNV-1a, 64 bits: names the file; its content is compared in full.
std::uint64_t hashOf(std::string_view text) {
    std::uint64_t hash = 14695981039346656037ull;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
    return hash;
}

template <class T>
void put(std::ostream& out, const T& value) {
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
bool take(std::string_view& bytes, T& value) {
    if (bytes.size() < sizeof value) return false;
    std::memcpy(&value, bytes.data(), sizeof value);
    bytes.remove_prefix(sizeof value);
    return true;
}

std::optional<GlProgram> readBinary(const std::filesystem::path& file, const std::string& key) {
    std::ifstream in(file, std::ios::binary);
    if (!in) return {};
    const std::string content((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    std::string_view rest = content;
    std::uint64_t keySize = 0;
    GLenum format = 0;
    char magic[sizeof kMagic] = {};
    if (!take(rest, magic) || std::memcmp(magic, kMagic, sizeof magic) != 0 || !take(rest, keySize))
        return {};
    if (rest.size() < keySize || rest.substr(0, keySize) != key) return {};
    rest.remove_prefix(keySize);
    if (!take(rest, format)) return {};
    auto program = GlProgram::fromBinary(format, rest.data(), static_cast<GLsizei>(rest.size()));
    if (!program) return {};
    return std::move(*program);
}

std::string driverName() {
    std::string name;
    for (GLenum what : {GL_VENDOR, GL_RENDERER, GL_VERSION}) {
        const auto* text = reinterpret_cast<const char*>(glGetString(what));
        name += fmt::format("{}\n", text != nullptr ? text : "");
    }
    return name;
}

}  // namespace

ProgramCache::ProgramCache() : m_driver(driverName()) {
    GLint formats = 0;
    glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
    if (formats > 0) m_folder = cacheFolder();
}

Result<ProgramCache::Found> ProgramCache::find(const ShaderText& text) {
    const std::string key = m_driver + text.vertex + text.fragment;
    if (const auto known = m_programs.find(key); known != m_programs.end())
        return Found{&known->second, Found::Origin::Memory};
    if (!m_folder.empty()) {
        if (auto stored = readBinary(fileOf(key), key))
            return Found{&m_programs.emplace(key, std::move(*stored)).first->second, Found::Origin::Disk};
    }
    auto compiled = GlProgram::compile(text);
    if (!compiled) return tl::unexpected(compiled.error());
    const auto& program = m_programs.emplace(key, std::move(*compiled)).first->second;
    if (!m_folder.empty()) store(key, program);
    return Found{&program, Found::Origin::Compiled};
}

std::filesystem::path ProgramCache::fileOf(const std::string& key) const {
    return m_folder / fmt::format("{:016x}.bin", hashOf(key));
}

void ProgramCache::store(const std::string& key, const GlProgram& program) const {
    GLint size = 0;
    glGetProgramiv(program.id(), GL_PROGRAM_BINARY_LENGTH, &size);
    if (size <= 0) return;
    std::string binary(static_cast<std::size_t>(size), '\0');
    GLenum format = 0;
    glGetProgramBinary(program.id(), size, &size, &format, binary.data());
    std::error_code ignored;
    std::filesystem::create_directories(m_folder, ignored);
    const auto file = fileOf(key);
    // Under a name of its own until it is whole: several programs may run at once.
    auto unfinished = file;
    unfinished += fmt::format(".{}", ::getpid());
    {
        std::ofstream out(unfinished, std::ios::binary);
        out.write(kMagic, sizeof kMagic);
        put(out, static_cast<std::uint64_t>(key.size()));
        out << key;
        put(out, format);
        out.write(binary.data(), size);
        if (!out.flush()) {
            std::filesystem::remove(unfinished, ignored);
            return;
        }
    }
    std::filesystem::rename(unfinished, file, ignored);
}

}  // namespace pellucid::renderer
