// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/lint/shaders.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace pellucid::lint {

namespace {

/// renderer/shaders/README.md: which stage implements which function.
constexpr std::array<std::pair<const char*, const char*>, 16> kFunctions = {{{"makeRay", "ray"},
                                                                             {"reconstruct", "reconstruct"},
                                                                             {"classify", "classify"},
                                                                             {"gradientMm", "gradient"},
                                                                             {"shade", "shade"},
                                                                             {"rayIsDone", "terminate"},
                                                                             {"composeBegin", "compose"},
                                                                             {"composeSample", "compose"},
                                                                             {"composeEnd", "compose"},
                                                                             {"traverse", "traverse"},
                                                                             {"refine", "refine"},
                                                                             {"occupiedSteps", "bounds"},
                                                                             {"emptySamples", "leap"},
                                                                             {"emptySegments", "leap"},
                                                                             {"cutToSlab", "slab"},
                                                                             {"encodePicture", "encode"}}};

struct Word {
    std::string text;
    std::size_t offset = 0;
    char next = ' ';  ///< The first character after it that is not a blank.
};

std::vector<Word> wordsOf(std::string_view code) {
    const auto inWord = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    std::vector<Word> words;
    for (std::size_t i = 0; i < code.size();) {
        if (!inWord(code[i])) {
            ++i;
            continue;
        }
        std::size_t end = i;
        while (end < code.size() && inWord(code[end])) ++end;
        const std::size_t after = code.find_first_not_of(" \n", end);
        words.push_back(
            {std::string(code.substr(i, end - i)), i, after == std::string_view::npos ? ' ' : code[after]});
        i = end;
    }
    return words;
}

/// The stages of the //@when that hold at an offset.
Names conditionsAt(std::string_view text, std::size_t offset) {
    std::vector<std::string> open;  // empty for //@unless
    for (std::size_t at = text.find("//@"); at < offset; at = text.find("//@", at + 3)) {
        const std::string_view line = text.substr(at, text.find('\n', at) - at);
        if (line.starts_with("//@when "))
            open.emplace_back(line.substr(8));
        else if (line.starts_with("//@unless "))
            open.emplace_back();
        else if (line == "//@end" && !open.empty())
            open.pop_back();
    }
    return {open.begin(), open.end()};
}

struct Declared {
    Names uniforms, blocks;
};

/// `uniform TYPE NAME;` is a plain uniform, `uniform NAME {` a block.
Declared declaredIn(const std::vector<Word>& words) {
    Declared declared;
    for (std::size_t i = 0; i + 1 < words.size(); ++i) {
        if (words[i].text != "uniform") continue;
        if (words[i + 1].next == '{') {
            declared.blocks.insert(words[i + 1].text);
        } else if (i + 2 < words.size()) {
            declared.uniforms.insert(words[i + 2].text);
        }
    }
    return declared;
}

void compareNames(const SourceFile& file, const char* kind, const Names& declared, const Names& row,
                  Findings& findings) {
    for (const std::string& name : declared) {
        if (row.count(name) == 0)
            findings.push_back(
                at(file, 0, std::string(kind) + " '" + name + "' is not in its row of the stage table"));
    }
    for (const std::string& name : row) {
        if (declared.count(name) == 0)
            findings.push_back(
                at(file, 0, std::string(kind) + " '" + name + "' of the stage table is not declared"));
    }
}

}  // namespace

Findings checkShader(const SourceFile& file, const ShaderFacts& row, const StageNeeds& needsOf) {
    Findings findings;
    const std::vector<Word> words = wordsOf(codeOnly(file.text));
    const Declared declared = declaredIn(words);
    compareNames(file, "uniform", declared.uniforms, row.uniforms, findings);
    compareNames(file, "block", declared.blocks, row.blocks, findings);
    for (const Word& word : words) {
        const auto function = std::find_if(kFunctions.begin(), kFunctions.end(), [&](const auto& entry) {
            return word.next == '(' && word.text == entry.first;
        });
        if (function == kFunctions.end() || function->second == row.stage) continue;
        const std::string stage = function->second;
        Names allowed = row.needs;
        for (const std::string& condition : conditionsAt(file.text, word.offset)) {
            allowed.insert(condition);
            if (const auto more = needsOf.find(condition); more != needsOf.end()) {
                allowed.insert(more->second.begin(), more->second.end());
            }
        }
        if (allowed.count(stage) > 0) continue;
        findings.push_back(
            at(file, word.offset, "calls " + word.text + "(), but its row does not need the stage " + stage));
    }
    return findings;
}

}  // namespace pellucid::lint
