// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace pellucid::accuracy {

/// A place in [a, b] where f changes sign, to the last bit or so. Precondition: f(a) and f(b) do not have the
/// same sign.
template <class F>
double rootBetween(double a, double b, F&& f) {
    const bool risesFromA = f(a) < 0.0;
    for (int i = 0; i < 100; ++i) {
        const double middle = a + (b - a) / 2.0;
        if (!(middle > a && middle < b)) break;
        ((f(middle) < 0.0) == risesFromA ? a : b) = middle;
    }
    return b;
}

/// The first t in [a, b] with f(t) >= 0, found on five samples and then by bisection; nothing when no sample
/// has it.
template <class F>
std::optional<double> firstReached(double a, double b, F&& f) {
    constexpr int kParts = 4;
    if (f(a) >= 0.0) return a;
    double before = a;
    for (int i = 1; i <= kParts; ++i) {
        const double here = i == kParts ? b : a + (b - a) * i / kParts;
        if (f(here) >= 0.0) return rootBetween(before, here, f);
        before = here;
    }
    return std::nullopt;
}

/// The largest value of f in [a, b], by golden sections; exact to rounding where f has one maximum there.
template <class F>
double maximumBetween(double a, double b, F&& f) {
    constexpr double kGolden = 0.6180339887498949;
    double low = b - kGolden * (b - a);
    double high = a + kGolden * (b - a);
    double fLow = f(low);
    double fHigh = f(high);
    // A maximum is flat: 40 sections leave 4e-9 of the interval, so 2e-17 of its curvature.
    for (int i = 0; i < 40; ++i) {
        if (fLow < fHigh) {
            a = low;
            low = high;
            fLow = fHigh;
            high = a + kGolden * (b - a);
            fHigh = f(high);
        } else {
            b = high;
            high = low;
            fHigh = fLow;
            low = b - kGolden * (b - a);
            fLow = f(low);
        }
    }
    return std::max(fLow, fHigh);
}

}  // namespace pellucid::accuracy
