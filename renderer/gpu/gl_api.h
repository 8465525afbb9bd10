// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The only place that includes the OpenGL loader; it must precede any other OpenGL header.
#include <epoxy/gl.h>
