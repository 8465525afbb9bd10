// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>

#include "renderer/gpu/gpu_context.h"

namespace pellucid::test {

/// A headless context for each test. Without OpenGL the tests are skipped, unless PELLUCID_REQUIRE_GL=1: then
/// they fail. Whatever the driver calls an error fails the test.
class GlTest : public testing::Test {
protected:
    void SetUp() override {
        auto context = renderer::GpuContext::headless();
        if (!context) {
            const char* required = std::getenv("PELLUCID_REQUIRE_GL");
            if (required != nullptr && std::string_view(required) == "1") FAIL() << context.error().text();
            GTEST_SKIP() << context.error().text();
        }
        m_context.emplace(std::move(*context));
    }
    void TearDown() override { EXPECT_EQ(renderer::takeGlErrors(), ""); }

private:
    std::optional<renderer::GpuContext> m_context;
};

}  // namespace pellucid::test
