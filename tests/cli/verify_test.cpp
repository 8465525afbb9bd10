// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace pellucid::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class VerifyCommand : public ProgramTest {};

TEST_F(VerifyCommand, PrintsATableAndSucceedsWhenAllPass) {
    const Outcome outcome = run({"verify", "--extreme", "--only", "opacity exactly"});
    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    EXPECT_EQ(outcome.err, "");
    for (const char* word : {"Pellucid ", "held to", "bound", "error", "pass", "2 cases, 0 failed"})
        EXPECT_THAT(outcome.out, HasSubstr(word));
    EXPECT_THAT(outcome.out, testing::Not(HasSubstr("FAIL")));
}

TEST_F(VerifyCommand, StopsByCtrlCWithoutHalfATable) {
    const Outcome outcome = run({"verify", "--json"}, 1500);
    EXPECT_EQ(outcome.status, 130) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, HasSubstr("cancelled"));
}

TEST_F(VerifyCommand, ExtremeCasesCanBeChosenByName) {
    const Outcome outcome = run({"verify", "--extreme", "--only", "opacity exactly", "--json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const json report = json::parse(outcome.out);
    EXPECT_TRUE(report.at("passed"));
    EXPECT_FALSE(report.at("driver").get<std::string>().empty());
    EXPECT_FALSE(report.contains("orders"));
    const json& rows = report.at("extreme").at("rows");
    ASSERT_EQ(rows.size(), 2u);
    for (const json& row : rows) {
        EXPECT_THAT(row.at("name").get<std::string>(), testing::StartsWith("opacity exactly"));
        EXPECT_TRUE(row.at("passed"));
        EXPECT_LE(row.at("error"), row.at("bound"));
    }
}

TEST_F(VerifyCommand, MistakesAreRefused) {
    expectRefusal({"verify", "--extrem"}, {"--extrem"});
    expectRefusal({"verify", "--only", "voxels"}, {"voxels", "grid"});
    expectRefusal({"verify", "--extreme", "--only", "no such case"}, {"no such case"});
}

}  // namespace
}  // namespace pellucid::cli
