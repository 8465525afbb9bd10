// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include "tests/cli/program.h"

namespace pellucid::cli {
namespace {

using testing::HasSubstr;

class ResampleCommand : public ProgramTest {};

TEST_F(ResampleCommand, WritesAVolumeThatInfoReads) {
    writeBall("ball.raw");
    for (const std::string method : {"sinc", "gaussian", "fourier"}) {
        const Outcome outcome = run({"resample", "ball.raw", "-o", "out.nrrd", "--method", method});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_THAT(outcome.out, HasSubstr("31 x 31 x 31 voxels"));
        EXPECT_THAT(run({"info", "out.nrrd"}).out, HasSubstr("31 x 31 x 31"));
    }
    EXPECT_THAT(run({"resample", "ball.raw", "-o", "half.nrrd", "--factor", "0.5"}).out,
                HasSubstr("8 x 8 x 8"));
}

TEST_F(ResampleCommand, SaysWhatItRefuses) {
    writeBall("ball.raw");
    expectRefusal({"resample", "ball.raw", "-o", "out.png"}, {".nrrd", "out.png"});
    expectRefusal({"resample", "ball.raw", "-o", "out.nrrd", "--factor", "0"}, {"factor", "1/64"});
    expectRefusal({"resample", "ball.raw", "-o", "out.nrrd", "--method", "cubic"}, {"--method", "cubic"});
    expectRefusal({"resample", "gone.raw", "-o", "out.nrrd"}, {"gone.raw"});
    EXPECT_FALSE(exists("out.nrrd"));
}

}  // namespace
}  // namespace pellucid::cli
