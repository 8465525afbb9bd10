// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/cli/program.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace pellucid::cli {

namespace fs = std::filesystem;

namespace {

std::string readAll(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

fs::path newFolder() {
    std::string name = (fs::temp_directory_path() / "pellucid-cli-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) ADD_FAILURE() << "no temporary folder";
    return name;
}

/// In the child between fork and exec: only calls that are safe there.
[[noreturn]] void become(char** arguments, const char* folder, const char* out, const char* err) {
    const int outFile = open(out, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int errFile = open(err, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int in = open("/dev/null", O_RDONLY);
    dup2(in, 0);
    dup2(outFile, 1);
    dup2(errFile, 2);
    if (chdir(folder) == 0) execv(PELLUCID_PROGRAM, arguments);
    _exit(127);
}

}  // namespace

Outcome runProgram(const std::vector<std::string>& arguments, const fs::path& folder, int interruptAfterMs) {
    const fs::path scratch = newFolder();
    const std::string out = (scratch / "out").string();
    const std::string err = (scratch / "err").string();
    std::vector<std::string> owned = {PELLUCID_PROGRAM};
    owned.insert(owned.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& argument : owned) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    const pid_t child = fork();
    if (child == 0) become(pointers.data(), folder.c_str(), out.c_str(), err.c_str());
    if (interruptAfterMs > 0) {
        usleep(static_cast<useconds_t>(interruptAfterMs) * 1000);
        kill(child, SIGINT);
    }
    int raw = 0;
    waitpid(child, &raw, 0);
    Outcome outcome{WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw), readAll(out), readAll(err)};
    fs::remove_all(scratch);
    return outcome;
}

void ProgramTest::SetUp() {
    m_folder = newFolder();
}

void ProgramTest::TearDown() {
    fs::remove_all(m_folder);
}

void ProgramTest::write(const std::string& name, const std::string& content) const {
    std::ofstream(path(name), std::ios::binary) << content;
}

std::string ProgramTest::read(const std::string& name) const {
    return readAll(path(name));
}

void ProgramTest::writeBall(const std::string& name) const {
    std::string voxels;
    for (int k = 0; k < 16; ++k) {
        for (int j = 0; j < 16; ++j) {
            for (int i = 0; i < 16; ++i) {
                const double x = i - 7.5, y = j - 7.5, z = k - 7.5;
                voxels.push_back(x * x + y * y + z * z < 36.0 ? static_cast<char>(200) : '\0');
            }
        }
    }
    write(name, voxels);
    write(name + ".json", R"({"size": [16, 16, 16], "type": "uint8", "spacingMm": [2, 2, 2]})");
}

void ProgramTest::writeBallScene(const std::string& name, const std::string& more) const {
    writeBall("ball.raw");
    write(
        name,
        R"({"pellucid": 1, "volumes": [{"source": "ball.raw", "transferFunction": {"points": [)"
        R"({"value": 50, "color": [1, 1, 1], "opacity": 0}, {"value": 150, "color": [1, 1, 1], "opacity": 0.5}]}}],)"
        R"("picture": {"size": [32, 32]})" +
            more + "}");
}

void ProgramTest::expectRefusal(const std::vector<std::string>& arguments,
                                const std::vector<std::string>& words) const {
    std::vector<std::string> before;
    for (const auto& entry : fs::directory_iterator(m_folder))
        before.push_back(entry.path().filename().string());
    const Outcome outcome = run(arguments);
    SCOPED_TRACE(testing::PrintToString(arguments) + "\n" + outcome.err);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(outcome.err.starts_with("pellucid: "));
    for (const std::string& word : words) EXPECT_THAT(outcome.err, testing::HasSubstr(word));
    std::vector<std::string> after;
    for (const auto& entry : fs::directory_iterator(m_folder))
        after.push_back(entry.path().filename().string());
    EXPECT_THAT(after, testing::UnorderedElementsAreArray(before)) << "a refusal leaves no file behind";
}

}  // namespace pellucid::cli
