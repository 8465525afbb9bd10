// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/peers/peer.h"

namespace pellucid::accuracy {

std::optional<std::string> whyNoPeers(const Scene&, const Volume&) {
    return "Peers were left out: this program was built without VTK's volume rendering.";
}

Result<PeerFrames> drawByPeer(const Scene&, const Volume&, const ReportSetting&, int) {
    return fail(ErrorCode::Unsupported, "this program was built without VTK's volume rendering");
}

}  // namespace pellucid::accuracy
