// SPDX-License-Identifier: MIT
// What starts keepers. The system copies the tables of all pages of a process that it clones, and this program grows
// large; the launcher is a copy of it from its first moments, and clones itself instead.
#pragma once

#include "verify/host/isolation/keeper.h"

namespace limitcheck::verify {

/// From now on keepers are started by a launcher, which this forks: call it early. They have the environment and the
/// folder that this program has now, and end with the thread that calls it. A process that is forked later gets a
/// launcher of its own with its first keeper.
void use_launcher();

/// Starts a keeper, which is a child of this process, as clone_keeper() does.
pid_t start_keeper(Containment containment, char* const* argv, const KeeperPipes& pipes);

}  // namespace limitcheck::verify
