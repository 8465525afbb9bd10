// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "tests/lint/rules.h"

namespace pellucid::lint {

namespace {

using Names = std::set<std::string, std::less<>>;

/// The arrows between rooms: what each may include besides itself. Tests may include all.
const std::map<std::string, Names, std::less<>>& arrows() {
    static const std::map<std::string, Names, std::less<>> table = {
        {"scene", {}},
        {"io", {"scene"}},
        {"segmentation", {"scene"}},
        {"renderer", {"scene"}},
        {"accuracy", {"scene", "renderer"}},
        {"tfeditor", {"scene"}},
        {"app", {"scene", "io", "segmentation", "renderer", "accuracy", "tfeditor"}},
        {"bench", {"scene", "io", "segmentation", "renderer", "accuracy", "app"}},
        {"tests", {"scene", "io", "segmentation", "renderer", "accuracy", "tfeditor", "app", "bench"}},
    };
    return table;
}

/// A library that only some places know: path prefixes of the files that may include it.
struct Foreign {
    const char* name;
    bool (*matches)(std::string_view header);
    std::vector<std::string> allowed;
};

bool isQt(std::string_view header) {
    const bool qtClass =
        header.size() > 1 && header[0] == 'Q' && std::isupper(static_cast<unsigned char>(header[1]));
    return qtClass || header.starts_with("Qt") || header.starts_with("qt") || header.starts_with("qopengl");
}

bool isGl(std::string_view header) {
    return header.starts_with("epoxy/") || header.starts_with("GL/") || header.starts_with("EGL/") ||
           header.starts_with("GLES");
}

const std::vector<Foreign>& foreigners() {
    static const std::vector<Foreign> table = {
        {"Qt", isQt, {"app/desktop/", "tfeditor/", "bench/", "tests/gui/"}},
        {"OpenGL", isGl, {"renderer/gpu/", "renderer/resources/", "renderer/passes/", "tests/gl/"}},
        {"VTK",
         [](std::string_view header) { return header.starts_with("vtk"); },
         {"io/", "segmentation/", "accuracy/", "bench/", "tests/io/", "tests/accuracy/"}},
        {"DCMTK",
         [](std::string_view header) { return header.starts_with("dcmtk/"); },
         {"io/", "bench/", "tests/io/"}},
        {"CLI11", [](std::string_view header) { return header.starts_with("CLI/"); }, {"app/cli/", "bench/"}},
    };
    return table;
}

/// Parts of a room that see less than the room does.
struct Inner {
    const char* part;
    std::vector<std::string> forbidden;
    const char* why;
};

const std::vector<Inner>& innerRules() {
    static const std::vector<Inner> table = {
        {"renderer/plan/",
         {"renderer/gpu/", "renderer/resources/", "renderer/passes/"},
         "a plan is made without a GPU"},
        {"app/cli/", {"app/desktop/"}, "the command line does not know the desktop"},
    };
    return table;
}

struct Include {
    std::string header;
    bool quoted = false;
    std::size_t offset = 0;
};

std::vector<Include> includesOf(const SourceFile& file) {
    std::vector<Include> includes;
    const std::string code =
        codeOnly(file.text);  // so that an #include in a comment or a string does not count
    std::size_t begin = 0;
    while (begin < code.size()) {
        const std::size_t end = std::min(code.find('\n', begin), code.size());
        const std::string_view stripped = std::string_view(code).substr(begin, end - begin);
        const std::string_view line = std::string_view(file.text).substr(begin, end - begin);
        const std::size_t hash = stripped.find_first_not_of(' ');
        const std::size_t open = line.find_first_of("<\"");
        if (hash != std::string_view::npos && stripped[hash] == '#' && open != std::string_view::npos &&
            stripped.find("include") < open) {
            const char closing = line[open] == '<' ? '>' : '"';
            const std::size_t close = line.find(closing, open + 1);
            if (close != std::string_view::npos) {
                includes.push_back(
                    {std::string(line.substr(open + 1, close - open - 1)), closing == '"', begin});
            }
        }
        begin = end + 1;
    }
    return includes;
}

std::string roomOf(std::string_view path) {
    return std::string(path.substr(0, path.find('/')));
}

const Foreign* foreignLibrary(std::string_view header) {
    for (const Foreign& foreign : foreigners()) {
        if (foreign.matches(header)) return &foreign;
    }
    return nullptr;
}

bool anyPrefix(const std::vector<std::string>& prefixes, std::string_view text) {
    return std::any_of(prefixes.begin(), prefixes.end(),
                       [&](const std::string& p) { return text.starts_with(p); });
}

/// What is wrong with a project header included from a room; empty when all is well.
std::string complaintOnRoom(const SourceFile& file, const std::string& header) {
    const std::string from = roomOf(file.name);
    const std::string to = roomOf(header);
    if (to == "embedded") return "";  // generated by embed_text() and private to its target
    if (arrows().count(to) == 0) return "includes \"" + header + "\": name project headers by their room";
    if (from != to && arrows().at(from).count(to) == 0) {
        return "includes \"" + header + "\": " + from + "/ must not depend on " + to + "/";
    }
    for (const Inner& inner : innerRules()) {
        if (file.name.starts_with(inner.part) && anyPrefix(inner.forbidden, header)) {
            return "includes \"" + header + "\": " + inner.why;
        }
    }
    return "";
}

}  // namespace

Findings checkIncludes(const SourceFile& file) {
    if (arrows().count(roomOf(file.name)) == 0) return {file.name + ": is in no room that the lint knows"};
    Findings findings;
    for (const Include& include : includesOf(file)) {
        std::string complaint;
        if (const Foreign* foreign = foreignLibrary(include.header)) {
            if (!anyPrefix(foreign->allowed, file.name)) {
                complaint = "includes <" + include.header + ">: " + foreign->name + " is not for this room";
            }
        } else if (include.quoted) {
            complaint = complaintOnRoom(file, include.header);
        }
        if (!complaint.empty()) findings.push_back(at(file, include.offset, complaint));
    }
    return findings;
}

Findings checkPrivateHeaders(const std::vector<SourceFile>& files) {
    std::map<std::string, std::string> privateHeaders;  // header to the library that makes it private
    for (const SourceFile& file : files) {
        if (!endsWith(file.name, ".h")) continue;
        for (const Include& include : includesOf(file)) {
            if (const Foreign* foreign = foreignLibrary(include.header))
                privateHeaders[file.name] = foreign->name;
        }
    }
    Findings findings;
    for (const SourceFile& file : files) {
        // Nothing is built upon these two.
        if (roomOf(file.name) == "tests" || roomOf(file.name) == "bench") continue;
        for (const Include& include : includesOf(file)) {
            const auto found = privateHeaders.find(include.header);
            if (found == privateHeaders.end() || roomOf(include.header) == roomOf(file.name)) continue;
            findings.push_back(at(file, include.offset,
                                  "includes \"" + include.header +
                                      "\", which is private to its room because it includes " +
                                      found->second));
        }
    }
    return findings;
}

}  // namespace pellucid::lint
