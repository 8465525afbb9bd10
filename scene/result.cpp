// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/result.h"

namespace pellucid {

std::string Error::text() const {
    std::string text;
    for (auto place = context.rbegin(); place != context.rend(); ++place) text += *place + ": ";
    return text + message;
}

}  // namespace pellucid
