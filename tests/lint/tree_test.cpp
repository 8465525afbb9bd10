// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "tests/lint/rules.h"

// Runs every rule over the project.
namespace pellucid::lint {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = PELLUCID_SOURCE_DIR;

std::string readText(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Every file of the project, by name, without what is built or hidden.
const std::vector<std::string>& names() {
    static const std::vector<std::string> all = [] {
        std::vector<std::string> found;
        for (auto i = fs::recursive_directory_iterator(kRoot); i != fs::recursive_directory_iterator(); ++i) {
            const std::string name = i->path().filename().string();
            if (i->is_directory() && (name.starts_with(".") || (i.depth() == 0 && name == "build"))) {
                i.disable_recursion_pending();
            } else if (i->is_regular_file()) {
                found.push_back(fs::relative(i->path(), kRoot).generic_string());
            }
        }
        std::sort(found.begin(), found.end());
        return found;
    }();
    return all;
}

std::vector<SourceFile> filesEndingIn(std::initializer_list<std::string_view> ends) {
    std::vector<SourceFile> files;
    for (const std::string& name : names()) {
        const bool wanted =
            std::any_of(ends.begin(), ends.end(), [&](std::string_view end) { return endsWith(name, end); });
        if (wanted) files.push_back({name, readText(kRoot / name)});
    }
    return files;
}

const std::vector<SourceFile>& cpp() {
    static const std::vector<SourceFile> files = filesEndingIn({".cpp", ".h"});
    return files;
}

const std::vector<SourceFile>& shaders() {
    static const std::vector<SourceFile> files = filesEndingIn({".glsl", ".frag", ".vert", ".comp", ".geom"});
    return files;
}

void expectNone(const Findings& findings) {
    for (const std::string& finding : findings) ADD_FAILURE() << finding;
}

TEST(LintTree, SeesTheProject) {
    EXPECT_GT(cpp().size(), 50u);
    EXPECT_GT(shaders().size(), 10u);
}

TEST(LintTree, DependenciesRunDownwards) {
    for (const SourceFile& file : cpp()) expectNone(checkIncludes(file));
    expectNone(checkPrivateHeaders(cpp()));
}

TEST(LintTree, NoBannedCalls) {
    for (const SourceFile& file : cpp()) expectNone(checkCalls(file));
}

TEST(LintTree, SourcesAreShortAsciiAndLicensed) {
    for (const std::vector<SourceFile>* files : {&cpp(), &shaders()}) {
        for (const SourceFile& file : *files) {
            expectNone(checkAscii(file));
            expectNone(checkLength(file));
        }
    }
    for (const SourceFile& file : cpp()) expectNone(checkHead(file));
    for (const SourceFile& file : filesEndingIn({"CMakeLists.txt", ".cmake"})) expectNone(checkAscii(file));
}

TEST(LintTree, TechniquesNameFilesAndTestsThatAreThere) {
    std::set<std::string> tests;
    for (const SourceFile& file : cpp()) {
        if (!file.name.starts_with("tests/")) continue;
        for (std::string& name : testsIn(file.text)) tests.insert(std::move(name));
    }
    const SourceFile page{"docs/techniques.md", readText(kRoot / "docs/techniques.md")};
    EXPECT_GT(techniqueRows(page.text).size(), 20u);
    expectNone(checkTechniques(
        page, [](const std::string& name) { return fs::is_regular_file(kRoot / name); },
        [&](const std::string& name) { return tests.count(name) > 0; }));
}

TEST(LintTree, LinksOfDocumentsLeadSomewhere) {
    for (const SourceFile& page : filesEndingIn({".md"})) {
        expectNone(checkLinks(page, [](const std::string& path) { return fs::exists(kRoot / path); }));
    }
}

}  // namespace
}  // namespace pellucid::lint
