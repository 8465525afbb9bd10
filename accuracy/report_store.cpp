// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/report_store.h"

#include <fmt/format.h>

#include <fstream>

namespace pellucid::accuracy {

Result<ReportStore> ReportStore::open(const std::filesystem::path& file, const std::string& context) {
    ReportStore store;
    store.m_file = file;
    store.m_context = context;
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return store;
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return fail(ErrorCode::Unreadable, fmt::format("{} cannot be read", file.string()));
    for (std::string line; std::getline(stream, line);) {
        const nlohmann::json json = nlohmann::json::parse(line, nullptr, false);
        if (!json.is_object() || !json.contains("key") || !json["key"].is_string() || !json.contains("value"))
            continue;
        if (json.value("context", nlohmann::json()) != context) continue;
        store.m_found[json["key"].get<std::string>()] = json["value"];
    }
    return store;
}

const nlohmann::json* ReportStore::find(const std::string& key) const {
    const auto found = m_found.find(key);
    return found == m_found.end() ? nullptr : &found->second;
}

Result<void> ReportStore::add(const std::string& key, nlohmann::json value) {
    // A line break first: the line before may have been cut off. Empty lines are passed over.
    const std::string line =
        "\n" + nlohmann::json{{"context", m_context}, {"key", key}, {"value", value}}.dump() + "\n";
    std::ofstream stream(m_file, std::ios::binary | std::ios::app);
    stream.write(line.data(), static_cast<std::streamsize>(line.size()));
    stream.flush();
    if (!stream) return fail(ErrorCode::WriteFailed, fmt::format("{} cannot be written", m_file.string()));
    m_found[key] = std::move(value);
    return {};
}

}  // namespace pellucid::accuracy
