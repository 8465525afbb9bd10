// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/plan/shader_assembly.h"

#include <algorithm>
#include <regex>
#include <sstream>

#include "embedded/renderer_shaders.h"
#include "renderer/plan/stages.h"
#include "scene/check.h"

namespace pellucid::renderer {

namespace {

constexpr const char* kVersionLine = "#version 450 core\n";

/// Drivers report lines faithfully but not all report the file number of `#line N K` (Mesa 22.3 says 0 for
/// every file): the file is told by the thousands of the line.
constexpr int kLinesPerFile = 1000;

/// Collects text, keeping the `//@when STAGE ... //@end` lines of chosen stages only and a #line before each
/// run.
class Assembler {
public:
    Assembler(const Features& features, const std::vector<StageRow>& rows)
        : m_features(features), m_rows(rows) {}

    ShaderText build() {
        m_text.vertex = kVersionLine + shaderFile("engine/fullscreen.vert");
        m_out << kVersionLine;
        if (m_features.lit) m_out << fmt::format("const int lightCount = {};\n", m_features.lights);
        if (m_features.surfaces > 0)
            m_out << fmt::format("const int surfaceCount = {};\n", m_features.surfaces);
        append("engine/raycast.frag");
        m_text.fragment = m_out.str();
        for (const char* uniform : engineUniforms()) m_text.uniforms.emplace_back(uniform);
        for (const auto& row : m_rows) {
            const StageVariant& variant = findVariant(row.stage, row.variant);
            m_text.uniforms.insert(m_text.uniforms.end(), variant.uniforms.begin(), variant.uniforms.end());
            m_text.blocks.insert(m_text.blocks.end(), variant.blocks.begin(), variant.blocks.end());
        }
        return std::move(m_text);
    }

private:
    bool has(std::string_view stage) const {
        return std::any_of(m_rows.begin(), m_rows.end(),
                           [&](const StageRow& row) { return row.stage == stage; });
    }

    void append(const std::string& path) {
        const std::size_t file = m_text.files.size();
        m_text.files.push_back(path);
        const auto mark = [&](int line) {
            m_out << "#line " << static_cast<int>(file) * kLinesPerFile + line << '\n';
        };
        mark(1);
        std::istringstream lines(shaderFile(path));
        std::string line;
        std::vector<bool> conditions;  // of the blocks that the line stands in
        const auto keep = [&] {
            return std::find(conditions.begin(), conditions.end(), false) == conditions.end();
        };
        const auto open = [&](bool holds, int next) {
            conditions.push_back(holds);
            if (keep()) mark(next);
        };
        for (int number = 1; std::getline(lines, line); ++number) {
            const std::size_t start = std::min(line.find_first_not_of(' '), line.size());
            const std::string_view content = std::string_view(line).substr(start);
            if (content.starts_with("//@when ")) {
                open(has(content.substr(8)), number + 1);
            } else if (content.starts_with("//@unless ")) {
                open(!has(content.substr(10)), number + 1);
            } else if (content == "//@end") {
                PELLUCID_CHECK(!conditions.empty());
                conditions.pop_back();
                if (keep()) mark(number + 1);
            } else if (content == "//@stages") {
                for (const auto& row : m_rows) append(fmt::format("{}/{}.glsl", row.stage, row.variant));
                mark(number + 1);
            } else if (keep()) {
                m_out << line << '\n';
            }
        }
    }

    const Features& m_features;
    const std::vector<StageRow>& m_rows;
    ShaderText m_text;
    std::ostringstream m_out;
};

}  // namespace

const std::string& shaderFile(const std::string& path) {
    static const std::map<std::string, std::string> files = [] {
        std::map<std::string, std::string> all;
        for (const auto& [name, text] : embedded::renderer_shaders()) all.emplace(name, text);
        return all;
    }();
    const auto found = files.find(path);
    PELLUCID_CHECK(found != files.end());
    return found->second;
}

ShaderText assembleShader(const Features& features, const std::vector<StageRow>& rows) {
    return Assembler(features, rows).build();
}

std::string locateInFiles(const std::string& driverLog, const std::vector<std::string>& files) {
    // Mesa and Intel: "0:3012(5): error ..."; NVIDIA: "0(3012) : error ...".
    static const std::regex place(R"((^|\n)\d+(?::(\d+)\(\d+\)|\((\d+)\)))");
    std::string located;
    auto rest = driverLog.cbegin();
    std::smatch match;
    while (std::regex_search(rest, driverLog.cend(), match, place)) {
        located.append(rest, match[0].first);
        const int number = std::stoi(match[2].matched ? match[2] : match[3]);
        const auto file = static_cast<std::size_t>(number / kLinesPerFile);
        located += fmt::format("{}{}:{}", match[1].str(), file < files.size() ? files[file] : "?",
                               number % kLinesPerFile);
        rest = match[0].second;
    }
    located.append(rest, driverLog.cend());
    return located;
}

}  // namespace pellucid::renderer
