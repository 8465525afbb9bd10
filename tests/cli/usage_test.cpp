// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include "tests/cli/program.h"

namespace pellucid::cli {
namespace {

using testing::HasSubstr;

class Usage : public ProgramTest {};

TEST_F(Usage, HelpOfEveryCommandTeachesWithExamples) {
    for (const std::string command :
         {"", "render", "info", "plan", "compare", "report", "resample", "verify"}) {
        const Outcome outcome = command.empty() ? run({"--help"}) : run({command, "--help"});
        SCOPED_TRACE(command);
        EXPECT_EQ(outcome.status, 0);
        EXPECT_EQ(outcome.err, "");
        EXPECT_THAT(outcome.out, HasSubstr("Examples:\n  pellucid " + command));
    }
    EXPECT_THAT(run({"doctor", "--help"}).out, HasSubstr("Exit status"));
}

TEST_F(Usage, HelpNamesEveryCommandAndTheExitStatuses) {
    const std::string help = run({"--help"}).out;
    for (const char* word : {"render", "info", "plan", "compare", "report", "resample", "doctor", "130",
                             "not a medical device"}) {
        EXPECT_THAT(help, HasSubstr(word));
    }
}

TEST_F(Usage, VersionIsOneLine) {
    const Outcome outcome = run({"--version"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.out, testing::MatchesRegex("Pellucid [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST_F(Usage, MistakesAreRefusedWithWhereToReadOn) {
    writeBall("ball.raw");
    expectRefusal({"--nonsense"}, {"--nonsense", "Try: pellucid --help"});
    expectRefusal({"render"}, {"required", "Try: pellucid render --help"});
    expectRefusal({"render", "ball.raw"}, {"--output", "Try: pellucid render --help"});
    expectRefusal({"render", "ball.raw", "-o", "ball.jpg"}, {"ball.jpg", ".png, .npy or .pfm"});
    expectRefusal({"info"}, {"required", "Try: pellucid info --help"});
    expectRefusal({"compare", "a.png"}, {"required", "Try: pellucid compare --help"});
    expectRefusal({"ball.raw", "info", "ball.raw"}, {"the command comes first"});
    expectRefusal({}, {"no display", "no scan was named"});
}

TEST_F(Usage, SettingsAreRefusedWithWhatIsAllowed) {
    writeBallScene("scene.json");
    const auto render = [](const std::string& option, const std::string& value) {
        return std::vector<std::string>{"render", "scene.json", "-o", "x.png", option, value};
    };
    expectRefusal(render("--size", "512"), {"--size", "512", "1024x768"});
    expectRefusal(render("--size", "0x5"), {"--size", "0x5"});
    expectRefusal(render("--size", "99999x5"), {"size", "99999", "16384"});
    expectRefusal(render("--view", "sideways"), {"/camera/view", "sideways", "anterior"});
    expectRefusal(render("--mode", "mipp"), {"/mode", "mipp", "mip"});
    expectRefusal(render("--preset", "CT bones"), {"--preset", "CT bones", "CT bone"});
    expectRefusal(render("--set", "mode"), {"--set", "key=value", "'mode'"});
    expectRefusal(render("--set", "camera.fovDeg=200"), {"/camera/fovDeg", "200", "180"});
    expectRefusal(render("--set", "camera.fov=20"), {"fov", "fovDeg"});
}

TEST_F(Usage, AViewTakesThePlaceOfAPose) {
    writeBallScene("scene.json", R"(, "camera": {"pose": {"eye": [0, -90, 0], "target": [0, 0, 0]}})");
    EXPECT_EQ(run({"render", "scene.json", "-o", "left.npy", "--view", "left"}).status, 0);
    writeBallScene("viewed.json", R"(, "camera": {"view": "left"})");
    EXPECT_EQ(run({"render", "viewed.json", "-o", "expected.npy"}).status, 0);
    EXPECT_EQ(read("left.npy"), read("expected.npy"));
}

TEST_F(Usage, DoctorDrawsTheKnownAnswerRight) {
    const Outcome outcome = run({"doctor"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    // 1 - exp(-0.25 * 8)
    for (const char* word :
         {"OpenGL", "Driver", "Limits", "= 0.864665, drawn 0.8646", ": right", "All is well."}) {
        EXPECT_THAT(outcome.out, HasSubstr(word));
    }
}

}  // namespace
}  // namespace pellucid::cli
