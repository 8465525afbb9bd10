// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/verification.h"

#include <array>
#include <cmath>

#include "tests/accuracy/gpu_fixture.h"

namespace pellucid::test {
namespace {

TEST(ObservedOrder, IsTheSlopeOfThePowerLaw) {
    const std::array sizes{2.0, 1.0, 0.5, 0.3};
    for (const double order : {0.5, 1.0, 2.0, 4.0}) {
        std::vector<double> errors;
        for (const double size : sizes) errors.push_back(3e-4 * std::pow(size, order));
        EXPECT_NEAR(accuracy::observedOrder(sizes, errors), order, 1e-12);
    }
}

TEST(ObservedOrder, IsNoNumberWithoutAnError) {
    EXPECT_TRUE(std::isnan(accuracy::observedOrder(std::array{2.0, 1.0, 0.5}, std::array{1e-3, 0.0, 0.0})));
}

TEST(OrderRow, PassesWithinItsToleranceOnly) {
    accuracy::OrderRow row;
    row.expected = 2.0;
    row.tolerance = 0.15;
    row.sizes = {1.0, 0.5};
    row.errors = {4e-3, 1e-3};
    EXPECT_TRUE(row.passed());
    row.errors = {4e-3, 2e-3};
    EXPECT_FALSE(row.passed()) << "first order";
    row.errors = {4e-3, 1e-4};
    EXPECT_FALSE(row.passed()) << "better than theory is as suspect";
    row.claim = accuracy::Claim::AtLeast;
    EXPECT_TRUE(row.passed());
    row.errors = {4e-3, 0.0};
    EXPECT_FALSE(row.passed()) << "no order";
    row.claim = accuracy::Claim::Independent;
    EXPECT_TRUE(row.passed());
    row.errors = {1e-3, std::nan("")};
    EXPECT_FALSE(row.passed()) << "NaN";
}

TEST(OrderRow, SaysWhatItIsHeldTo) {
    accuracy::OrderRow row{"pixel", "composite", "", "nearest"};
    row.claim = accuracy::Claim::AtLeast;
    row.expected = 1.5;
    row.tolerance = 0.15;
    row.reason = "kinks";
    row.sizes = {1.0, 0.5};
    row.errors = {4e-3, 2e-3};
    const accuracy::VerificationLine line = lineOf(row);
    EXPECT_EQ(line.name, "pixel: composite, nearest");
    EXPECT_EQ(line.theory, "order >= 1.5 +- 0.15");
    EXPECT_EQ(line.observed, "1.00");
    EXPECT_FALSE(line.passed);
    EXPECT_EQ(line.reason, "kinks");
}

class Verify : public GpuTest {};

TEST_F(Verify, EveryObservedOrderIsAsTheorySays) {
    std::size_t found = 0;
    const auto verification =
        accuracy::verify(gpu(), {}, {}, [&](const accuracy::VerificationLine&) { ++found; });
    ASSERT_TRUE(verification && verification->orders);
    EXPECT_FALSE(verification->extremes);
    EXPECT_GE(verification->orders->size(), 240u);
    EXPECT_EQ(found, verification->orders->size());
    EXPECT_TRUE(verification->passed()) << accuracy::verificationText(*verification);
}

TEST_F(Verify, StopsWhenAsked) {
    const auto rows = accuracy::verify(gpu(), {}, [](double, std::string_view) { return false; });
    ASSERT_FALSE(rows);
    EXPECT_EQ(rows.error().code, ErrorCode::Cancelled);
}

}  // namespace
}  // namespace pellucid::test
