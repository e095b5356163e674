// SPDX-License-Identifier: MIT
// limitcheck-worker: serves a shared library to an audit. An audit starts thousands of processes, and `limitcheck` takes ten
// times as long to start: it is linked with all its peers.
#include "verify/host/isolation/worker.h"

int main(int argc, char** argv) {
  return limitcheck::verify::serve(argc, argv, "library", limitcheck::verify::load_subject);
}
