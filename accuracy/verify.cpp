// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/verify.h"

#include <algorithm>
#include <cmath>

#include "scene/check.h"

namespace pellucid::accuracy {

double observedOrder(std::span<const double> sizes, std::span<const double> errors) {
    PELLUCID_CHECK(sizes.size() == errors.size() && sizes.size() >= 2);
    const auto n = static_cast<double>(sizes.size());
    double meanX = 0.0, meanY = 0.0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        meanX += std::log(sizes[i]) / n;
        meanY += std::log(errors[i]) / n;
    }
    double xy = 0.0, xx = 0.0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        const double x = std::log(sizes[i]) - meanX;
        xy += x * (std::log(errors[i]) - meanY);
        xx += x * x;
    }
    // log(0) is infinite, and what follows from it NaN: no order.
    return xy / xx;
}

double OrderRow::observed() const {
    if (claim != Claim::Independent) return observedOrder(sizes, errors);
    double largest = 0.0;
    for (const double error : errors)
        if (!(error <= largest)) largest = error;
    return largest;
}

bool OrderRow::passed() const {
    const double found = observed();
    switch (claim) {
        case Claim::Order:
            return std::abs(found - expected) <= tolerance;
        case Claim::AtLeast:
            return found >= expected - tolerance;
        case Claim::Independent:
            break;
    }
    return found <= tolerance;
}

bool allPassed(std::span<const OrderRow> rows) {
    return std::all_of(rows.begin(), rows.end(), [](const OrderRow& row) { return row.passed(); });
}

}  // namespace pellucid::accuracy
