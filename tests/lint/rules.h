// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Lint rules as pure functions of a file's name (relative to the project, with '/') and text.
namespace pellucid::lint {

/// "scene/grid.h:12: what is wrong and what to do".
using Findings = std::vector<std::string>;

struct SourceFile {
    std::string name;
    std::string text;
};

/// Dependencies run downwards only (docs/architecture.md): which room may include which, and which of them
/// may include OpenGL, Qt, VTK, DCMTK and CLI11.
[[nodiscard]] Findings checkIncludes(const SourceFile& file);

/// Headers of one room that name Qt, VTK, DCMTK or OpenGL are private to it: no other room includes them.
[[nodiscard]] Findings checkPrivateHeaders(const std::vector<SourceFile>& files);

/// No atof, strtod, stod, sscanf (they follow the locale), rand, exit; no printing below app/, except in
/// tests and benchmarks.
[[nodiscard]] Findings checkCalls(const SourceFile& file);

[[nodiscard]] Findings checkAscii(const SourceFile& file);

/// At most 450 lines.
[[nodiscard]] Findings checkLength(const SourceFile& file);

/// The two SPDX lines come first, and headers have #pragma once.
[[nodiscard]] Findings checkHead(const SourceFile& file);

/// Every relative link of a Markdown file names something that `exists` (a path relative to the project).
template <class Exists>
[[nodiscard]] Findings checkLinks(const SourceFile& file, const Exists& exists);

/// Rows of the table of techniques (ID | technique | source files | tests): every `file` and every
/// `Suite.Test` named there is there, and every row names both.
template <class Exists, class HasTest>
[[nodiscard]] Findings checkTechniques(const SourceFile& file, const Exists& exists, const HasTest& hasTest);

/// The text with comments and the contents of strings and characters replaced by blanks, line by line as
/// before.
[[nodiscard]] std::string codeOnly(std::string_view text);

[[nodiscard]] bool endsWith(std::string_view text, std::string_view end);
[[nodiscard]] std::string at(const SourceFile& file, std::size_t offset, std::string_view what);

/// Targets of [text](target) that are neither on the web nor inside the page, without #anchors, with their
/// offsets.
[[nodiscard]] std::vector<std::pair<std::string, std::size_t>> relativeLinks(std::string_view markdown);

/// One row of a Markdown table whose first cell is an ID: the names in backquotes of its third and fourth
/// cell.
struct TechniqueRow {
    std::string id;
    std::vector<std::string> files, tests;
    std::size_t offset = 0;
};
[[nodiscard]] std::vector<TechniqueRow> techniqueRows(std::string_view markdown);

/// "Suite.Name" of every TEST, TEST_F and TEST_P of a test file.
[[nodiscard]] std::vector<std::string> testsIn(std::string_view text);

template <class Exists, class HasTest>
Findings checkTechniques(const SourceFile& file, const Exists& exists, const HasTest& hasTest) {
    Findings findings;
    for (const TechniqueRow& row : techniqueRows(file.text)) {
        if (row.files.empty() || row.tests.empty())
            findings.push_back(at(file, row.offset, row.id + " names no file or no test"));
        for (const std::string& name : row.files) {
            if (!exists(name))
                findings.push_back(
                    at(file, row.offset, row.id + " names the file '" + name + "', which is not there"));
        }
        for (const std::string& name : row.tests) {
            if (!hasTest(name))
                findings.push_back(
                    at(file, row.offset, row.id + " names the test '" + name + "', which is not there"));
        }
    }
    return findings;
}

template <class Exists>
Findings checkLinks(const SourceFile& file, const Exists& exists) {
    const std::size_t slash = file.name.rfind('/');
    const std::string folder = slash == std::string::npos ? "" : file.name.substr(0, slash + 1);
    Findings findings;
    for (const auto& [target, offset] : relativeLinks(file.text)) {
        if (!exists(folder + target))
            findings.push_back(at(file, offset, "links to '" + target + "', which is not there"));
    }
    return findings;
}

}  // namespace pellucid::lint
