// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/lint/rules.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace pellucid::lint {

namespace {

constexpr int kMaxLines = 450;

bool isWordCharacter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// Offsets at which `word` stands alone.
std::vector<std::size_t> wordsIn(std::string_view code, std::string_view word) {
    std::vector<std::size_t> offsets;
    for (std::size_t i = code.find(word); i != std::string_view::npos; i = code.find(word, i + 1)) {
        const std::size_t end = i + word.size();
        const bool startsHere = i == 0 || !isWordCharacter(code[i - 1]);
        if (startsHere && (end == code.size() || !isWordCharacter(code[end]))) offsets.push_back(i);
    }
    return offsets;
}

/// True for `exit(...)` and `std::exit(...)`, not for `app.exit(...)`, `QApplication::exit(...)` or `void
/// exit(int)`.
bool isFreeCall(std::string_view code, std::size_t begin, std::size_t length) {
    const std::size_t next = code.find_first_not_of(" \n", begin + length);
    if (next == std::string_view::npos || code[next] != '(') return false;
    const std::string_view before = code.substr(0, begin);
    if (endsWith(before, "std::")) return true;
    if (endsWith(before, "::")) return before.size() < 3 || !isWordCharacter(before[before.size() - 3]);
    return !endsWith(before, ".") && !endsWith(before, "->");
}

bool mayPrint(const std::string& name) {
    return name.starts_with("app/") || name.starts_with("tests/") || name.starts_with("bench/") ||
           name.find("bench") != std::string::npos;
}

/// Blanks out one construct of the text from `begin` to `end`, keeping the ends of lines.
void blank(std::string& text, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < std::min(end, text.size()); ++i) {
        if (text[i] != '\n') text[i] = ' ';
    }
}

/// End of a "..." or '...' that begins at `begin`, after its closing quote.
std::size_t endOfQuoted(std::string_view text, std::size_t begin) {
    std::size_t i = begin + 1;
    while (i < text.size() && text[i] != text[begin] && text[i] != '\n') i += text[i] == '\\' ? 2 : 1;
    return std::min(i + 1, text.size());
}

/// End of a raw string whose quote stands at `quote`: R"tag( ... )tag".
std::size_t endOfRaw(std::string_view text, std::size_t quote) {
    const std::size_t open = text.find('(', quote);
    if (open == std::string_view::npos) return text.size();
    const std::string close = ")" + std::string(text.substr(quote + 1, open - quote - 1)) + "\"";
    const std::size_t end = text.find(close, open);
    return end == std::string_view::npos ? text.size() : end + close.size();
}

std::size_t orEnd(std::size_t found, std::string_view text) {
    return found == std::string_view::npos ? text.size() : found;
}

}  // namespace

bool endsWith(std::string_view text, std::string_view end) {
    return text.ends_with(end);
}

std::string at(const SourceFile& file, std::size_t offset, std::string_view what) {
    const auto line =
        1 + std::count(file.text.begin(), file.text.begin() + static_cast<std::ptrdiff_t>(offset), '\n');
    return file.name + ":" + std::to_string(line) + ": " + std::string(what);
}

std::string codeOnly(std::string_view original) {
    std::string text(original);
    std::size_t i = 0;
    while (i < text.size()) {
        std::size_t end = i + 1;
        if (original.substr(i, 2) == "//") {
            end = orEnd(original.find('\n', i), original);
            blank(text, i, end);
        } else if (original.substr(i, 2) == "/*") {
            end = orEnd(original.find("*/", i + 2), original);
            end = std::min(end + 2, original.size());
            blank(text, i, end);
        } else if (original.substr(i, 2) == "R\"") {
            end = endOfRaw(original, i + 1);
            blank(text, i, end);
        } else if (original[i] == '"') {
            end = endOfQuoted(original, i);
            blank(text, i + 1, end - 1);
        } else if (original[i] == '\'' && (i == 0 || !isWordCharacter(original[i - 1]))) {
            end = endOfQuoted(original, i);  // a quote after a digit or letter separates digits: 1'000
            blank(text, i + 1, end - 1);
        }
        i = end;
    }
    return text;
}

Findings checkCalls(const SourceFile& file) {
    static constexpr std::array kBanned = {"atof",   "strtod", "strtof", "stod", "stof",
                                           "sscanf", "rand",   "srand",  "exit"};
    static constexpr std::array kPrinting = {"std::cout", "std::cerr", "printf", "puts", "fmt::print"};
    const std::string code = codeOnly(file.text);
    Findings findings;
    for (const std::string_view call : kBanned) {
        for (const std::size_t offset : wordsIn(code, call)) {
            if (!isFreeCall(code, offset, call.size())) continue;
            findings.push_back(at(
                file, offset, std::string(call) + "() is banned: use std::from_chars, <random> or a Result"));
        }
    }
    if (mayPrint(file.name)) return findings;
    for (const std::string_view printing : kPrinting) {
        for (const std::size_t offset : wordsIn(code, printing)) {
            findings.push_back(
                at(file, offset, std::string(printing) + ": libraries do not print, they return warnings"));
        }
    }
    return findings;
}

Findings checkAscii(const SourceFile& file) {
    const auto odd = std::find_if(file.text.begin(), file.text.end(),
                                  [](char c) { return static_cast<signed char>(c) < 0; });
    if (odd == file.text.end()) return {};
    return {at(file, static_cast<std::size_t>(odd - file.text.begin()), "is not ASCII")};
}

Findings checkLength(const SourceFile& file) {
    const auto lines = std::count(file.text.begin(), file.text.end(), '\n');
    if (lines <= kMaxLines) return {};
    return {file.name + ": has " + std::to_string(lines) + " lines, allowed are " +
            std::to_string(kMaxLines) + ": split it by what it does"};
}

Findings checkHead(const SourceFile& file) {
    static constexpr std::string_view kHead =
        "// SPDX-FileCopyrightText: Pellucid contributors\n// SPDX-License-Identifier: BSD-3-Clause\n";
    Findings findings;
    if (!file.text.starts_with(kHead))
        findings.push_back(file.name + ":1: does not begin with the two SPDX lines");
    if (endsWith(file.name, ".h") && codeOnly(file.text).find("#pragma once") == std::string::npos) {
        findings.push_back(file.name + ": has no #pragma once");
    }
    return findings;
}

std::vector<std::pair<std::string, std::size_t>> relativeLinks(std::string_view markdown) {
    std::vector<std::pair<std::string, std::size_t>> links;
    for (std::size_t i = markdown.find("]("); i != std::string_view::npos; i = markdown.find("](", i + 1)) {
        const std::string_view rest = markdown.substr(i + 2);
        const std::string_view target = rest.substr(0, rest.find_first_of(") #\n"));
        if (target.empty() || target.find("://") != std::string_view::npos) continue;
        links.emplace_back(std::string(target), i);
    }
    return links;
}

}  // namespace pellucid::lint
