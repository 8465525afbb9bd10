// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/extreme.h"

#include "tests/accuracy/gpu_fixture.h"

namespace pellucid::test {
namespace {

class Extreme : public GpuTest {};

TEST_F(Extreme, EveryCaseIsWithinItsBound) {
    const auto rows = accuracy::verifyExtremes(gpu());
    ASSERT_TRUE(rows);
    EXPECT_GE(rows->size(), 150u);
    EXPECT_TRUE(accuracy::allPassed(*rows)) << accuracy::extremeText(*rows);
}

/// The judge itself: a wrong closed form, an unexpected picture and an unexpected refusal all fail.
TEST_F(Extreme, WrongAnswersFail) {
    auto cases = accuracy::extremeCases();
    accuracy::ExtremeCase drawn = cases.front();
    EXPECT_TRUE(accuracy::verifyExtreme(gpu(), drawn).passed);
    drawn.truth = accuracy::EveryPixel{glm::dvec4(0.5)};
    EXPECT_FALSE(accuracy::verifyExtreme(gpu(), drawn).passed);
    drawn.truth = accuracy::Refused{"samples"};
    EXPECT_FALSE(accuracy::verifyExtreme(gpu(), drawn).passed);
    for (accuracy::ExtremeCase& refused : cases)
        if (std::holds_alternative<accuracy::Refused>(refused.truth)) {
            refused.truth = accuracy::AsReference{};
            EXPECT_FALSE(accuracy::verifyExtreme(gpu(), refused).passed) << refused.name;
        }
}

}  // namespace
}  // namespace pellucid::test
