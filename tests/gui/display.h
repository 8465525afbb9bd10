// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace pellucid::test {

/// Gives this process an X display of its own (Xvfb, ended with the process), so that tests that run at the
/// same time do not disturb each other. Without Xvfb the display of the environment is used. Call before
/// QApplication is made.
void provideDisplay();

/// True when GoogleTest is only asked for the names of the tests, which needs no display. Call after
/// InitGoogleTest.
bool onlyListsTests();

}  // namespace pellucid::test
