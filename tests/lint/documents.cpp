// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "tests/lint/rules.h"

namespace pellucid::lint {

namespace {

std::vector<std::string> quotedIn(std::string_view cell) {
    std::vector<std::string> names;
    std::size_t open = cell.find('`');
    while (open != std::string_view::npos) {
        const std::size_t close = cell.find('`', open + 1);
        if (close == std::string_view::npos) break;
        names.emplace_back(cell.substr(open + 1, close - open - 1));
        open = cell.find('`', close + 1);
    }
    return names;
}

/// The cells of `| a | b |`, without the blanks around them; none for another line.
std::vector<std::string> cellsOf(std::string_view line) {
    std::vector<std::string> cells;
    if (!line.starts_with("|")) return cells;
    std::size_t begin = 1;
    for (std::size_t bar = line.find('|', 1); bar != std::string_view::npos; bar = line.find('|', begin)) {
        std::string_view cell = line.substr(begin, bar - begin);
        while (cell.starts_with(' ')) cell.remove_prefix(1);
        while (cell.ends_with(' ')) cell.remove_suffix(1);
        cells.emplace_back(cell);
        begin = bar + 1;
    }
    return cells;
}

bool isId(std::string_view cell) {
    return cell.size() >= 2 && cell[0] >= 'A' && cell[0] <= 'Z' && cell[1] >= '0' && cell[1] <= '9';
}

}  // namespace

std::vector<TechniqueRow> techniqueRows(std::string_view markdown) {
    std::vector<TechniqueRow> rows;
    std::size_t begin = 0;
    while (begin < markdown.size()) {
        const std::size_t end = std::min(markdown.find('\n', begin), markdown.size());
        const std::vector<std::string> cells = cellsOf(markdown.substr(begin, end - begin));
        if (cells.size() >= 4 && isId(cells[0])) {
            rows.push_back({cells[0], quotedIn(cells[2]), quotedIn(cells[3]), begin});
        }
        begin = end + 1;
    }
    return rows;
}

std::vector<std::string> testsIn(std::string_view text) {
    const std::string code = codeOnly(text);
    std::vector<std::string> names;
    for (const std::string_view macro : {"TEST(", "TEST_F(", "TEST_P("}) {
        for (std::size_t i = code.find(macro); i != std::string::npos; i = code.find(macro, i + 1)) {
            const std::size_t open = i + macro.size();
            const std::size_t comma = code.find(',', open);
            const std::size_t close = code.find(')', open);
            if (comma == std::string::npos || close == std::string::npos || comma > close) continue;
            std::string name =
                code.substr(open, comma - open) + "." + code.substr(comma + 1, close - comma - 1);
            std::erase_if(name, [](char c) { return c == ' ' || c == '\n'; });
            names.push_back(name);
        }
    }
    return names;
}

}  // namespace pellucid::lint
