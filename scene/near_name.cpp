// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/near_name.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace pellucid {

namespace {

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t substituted = diagonal + (lower(a[i]) == lower(b[j]) ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({substituted, row[j] + 1, diagonal + 1});
        }
    }
    return row[b.size()];
}

bool beginsWith(std::string_view name, std::string_view text) {
    return text.size() >= 3 && text.size() < name.size() &&
           std::equal(text.begin(), text.end(), name.begin(),
                      [](char a, char b) { return lower(a) == lower(b); });
}

}  // namespace

std::optional<std::string> nearestName(std::string_view text, std::span<const std::string> names) {
    std::optional<std::string> nearest;
    std::size_t best = std::max<std::size_t>(2, text.size() / 3) + 1;
    for (const std::string& name : names) {
        // A hostile text of a megabyte is near to no name, and need not be compared.
        if (text.size() > 2 * name.size() + 4) continue;
        const std::size_t distance = beginsWith(name, text) ? 1 : editDistance(text, name);
        if (distance < best && distance < name.size()) {
            best = distance;
            nearest = name;
        }
    }
    return nearest;
}

}  // namespace pellucid
