// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace pellucid::cli {

struct Outcome {
    int status = -1;  ///< Exit status; 128 + signal when one ended it.
    std::string out;
    std::string err;
};

/// Runs the built program in `folder` without a display. No shell: arguments arrive as they are. With
/// `interruptAfterMs`, presses Ctrl-C that long after the start.
Outcome runProgram(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                   int interruptAfterMs = 0);

/// A temporary folder for each test, with the smallest inputs that mean something.
class ProgramTest : public testing::Test {
protected:
    void SetUp() override;
    void TearDown() override;

    [[nodiscard]] std::filesystem::path path(const std::string& name) const { return m_folder / name; }
    [[nodiscard]] Outcome run(const std::vector<std::string>& arguments, int interruptAfterMs = 0) const {
        return runProgram(arguments, m_folder, interruptAfterMs);
    }
    void write(const std::string& name, const std::string& content) const;
    [[nodiscard]] std::string read(const std::string& name) const;
    [[nodiscard]] bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }

    /// A ball of value 200 in 16x16x16 voxels of uint8 as `name` and its sidecar `name`.json.
    void writeBall(const std::string& name) const;
    /// A scene that draws that ball in white, 32x32 pixels; `more` holds further members, each with a comma
    /// before it.
    void writeBallScene(const std::string& name, const std::string& more = "") const;

    /// Refused as a person can use it: status 2, nothing on stdout, one sentence on stderr with all the
    /// words, no traces.
    void expectRefusal(const std::vector<std::string>& arguments,
                       const std::vector<std::string>& words) const;

private:
    std::filesystem::path m_folder;
};

}  // namespace pellucid::cli
