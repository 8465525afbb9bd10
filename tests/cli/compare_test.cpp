// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "tests/cli/program.h"

namespace pellucid::cli {
namespace {

using testing::HasSubstr;

class Compare : public ProgramTest {
protected:
    /// A 4x2 .pfm of one grey value, with another in the pixel at the top left.
    void writeGrey(const std::string& name, float value, float topLeft) const {
        std::string pfm = "PF\n4 2\n-1.0\n";
        for (int i = 0; i < 8 * 3; ++i) {
            const float shown = i / 3 == 4 ? topLeft : value;  // the bottom row comes first
            char bytes[sizeof shown];
            std::memcpy(bytes, &shown, sizeof shown);
            pfm.append(bytes, sizeof shown);
        }
        write(name, pfm);
    }
};

TEST_F(Compare, EqualPicturesDoNotDiffer) {
    writeGrey("a.pfm", 0.5f, 0.5f);
    const Outcome outcome = run({"compare", "a.pfm", "a.pfm", "--max", "0", "--rmse", "0", "--ssim", "1"});
    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
}

TEST_F(Compare, CountsInGreyLevelsAndHoldsEachLimit) {
    writeGrey("a.pfm", 0.5f, 0.5f);
    writeGrey("b.pfm", 0.5f, 0.5f + 8.0f / 255.0f);
    // One of eight pixels is off by 8 grey levels: RMSE = sqrt(8^2 / 8) = 2.828, mean = 1.
    const Outcome outcome = run({"compare", "a.pfm", "b.pfm"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.out, HasSubstr("at pixel 0, 0"));
    const auto status = [&](const std::string& option, const std::string& limit) {
        return run({"compare", "a.pfm", "b.pfm", option, limit}).status;
    };
    EXPECT_EQ(status("--max", "7.99"), 1);
    EXPECT_EQ(status("--max", "8.01"), 0);
    EXPECT_EQ(status("--rmse", "2.82"), 1);
    EXPECT_EQ(status("--rmse", "2.84"), 0);
    EXPECT_EQ(status("--ssim", "0.99999"), 1);
    EXPECT_EQ(status("--ssim", "0.1"), 0);
    EXPECT_EQ(run({"compare", "a.pfm", "b.pfm", "--max", "9", "--rmse", "1"}).status, 1)
        << "one limit is enough";
}

TEST_F(Compare, NotANumberIsBeyondEveryLimitAndWithoutOne) {
    writeGrey("a.pfm", 0.5f, 0.5f);
    writeGrey("nan.pfm", 0.5f, std::numeric_limits<float>::quiet_NaN());
    EXPECT_EQ(run({"compare", "a.pfm", "nan.pfm", "--max", "1000"}).status, 1);
    EXPECT_EQ(run({"compare", "a.pfm", "nan.pfm"}).status, 1);
    EXPECT_EQ(run({"compare", "nan.pfm", "nan.pfm"}).status, 1);
}

TEST_F(Compare, WhatCannotBeComparedIsRefused) {
    writeGrey("a.pfm", 0.5f, 0.5f);
    write("wide.pfm", "PF\n5 1\n-1.0\n" + std::string(5 * 12, '\0'));
    write("note.txt", "no picture");
    expectRefusal({"compare", "a.pfm", "wide.pfm"}, {"4 x 2", "5 x 1"});
    expectRefusal({"compare", "a.pfm", "gone.png"}, {"gone.png"});
    expectRefusal({"compare", "note.txt", "a.pfm"}, {"note.txt"});
    expectRefusal({"compare", "a.pfm", "a.pfm", "--max", "much"}, {"--max"});
}

}  // namespace
}  // namespace pellucid::cli
