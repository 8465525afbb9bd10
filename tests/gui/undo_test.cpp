// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "app/desktop/undo_stack.h"

namespace pellucid::app {
namespace {

Scene dense(double density) {
    Scene scene;
    scene.densityScale = density;
    return scene;
}

TEST(UndoStack, GivesBackTheScenesAndTheirNamesInOrder) {
    UndoStack stack;
    EXPECT_FALSE(stack.canUndo());
    stack.push("first", dense(1), dense(2), {});
    stack.push("second", dense(2), dense(3), {});
    EXPECT_EQ(stack.undoName(), "second");
    EXPECT_EQ(stack.undo(), dense(2));
    EXPECT_EQ(stack.redoName(), "second");
    EXPECT_EQ(stack.undoName(), "first");
    EXPECT_EQ(stack.undo(), dense(1));
    EXPECT_FALSE(stack.canUndo());
    EXPECT_EQ(stack.redo(), dense(2));
    EXPECT_EQ(stack.redo(), dense(3));
    EXPECT_FALSE(stack.canRedo());
}

TEST(UndoStack, AGestureIsOneEntryUntilItIsClosed) {
    UndoStack stack;
    stack.push("drag", dense(1), dense(2), "g");
    stack.push("drag", dense(2), dense(3), "g");
    stack.closeGesture();
    stack.push("drag", dense(3), dense(4), "g");
    EXPECT_EQ(stack.undo(), dense(3));
    EXPECT_EQ(stack.undo(), dense(1));
    EXPECT_EQ(stack.redo(), dense(3));
}

TEST(UndoStack, AGestureThatReturnsToItsStartLeavesNothing) {
    UndoStack stack;
    stack.push("kept", dense(0), dense(1), {});
    stack.push("drag", dense(1), dense(2), "g");
    stack.push("drag", dense(2), dense(1), "g");
    stack.closeGesture();
    EXPECT_EQ(stack.undoName(), "kept");
}

TEST(UndoStack, AnotherGestureIsAnotherEntry) {
    UndoStack stack;
    stack.push("a", dense(1), dense(2), "a");
    stack.push("b", dense(2), dense(3), "b");
    EXPECT_EQ(stack.undo(), dense(2));
}

TEST(UndoStack, AChangeAfterUndoDropsWhatCouldBeRedone) {
    UndoStack stack;
    stack.push("a", dense(1), dense(2), "g");
    EXPECT_EQ(stack.undo(), dense(1));
    stack.push("b", dense(1), dense(5), "g");
    EXPECT_FALSE(stack.canRedo());
    EXPECT_EQ(stack.undoName(), "b");
    EXPECT_EQ(stack.undo(), dense(1));
}

TEST(UndoStack, AnUnchangedSceneIsNoStep) {
    UndoStack stack;
    stack.push("nothing", dense(1), dense(1), {});
    EXPECT_FALSE(stack.canUndo());
}

}  // namespace
}  // namespace pellucid::app
