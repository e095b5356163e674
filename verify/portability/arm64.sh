#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Cross-builds data, reference, fast and their tests for arm64 and runs them under qemu-user; and the test that
# hashes 600 000 points, which must give the bits that x86-64 gives.
# usage: bash verify/portability/arm64.sh [--quick]   (--quick: the hash alone)
# Needs Debian 12, and root for the cross-compiler and qemu-user. The arm64 libraries are only unpacked, into
# build/arm64-sysroot: nothing of another architecture is installed.
set -euo pipefail
cd "$(dirname "$0")/../.."
sysroot=$PWD/build/arm64-sysroot

packages=(libboost1.74-dev libcgal-dev libflint-arb-dev libflint-arb2 libflint-dev libflint17 libfmt-dev libfmt9
  libgmp-dev libgmp10 libgmpxx4ldbl libgtest-dev libhwy-dev libhwy1 libmpfr-dev libmpfr6 libntl44 libgf2x3 libtbb-dev libtbb12
  libtbbbind-2-5 libtbbmalloc2 nlohmann-json3-dev libeigen3-dev)

if ! command -v aarch64-linux-gnu-g++ > /dev/null || ! command -v qemu-aarch64 > /dev/null; then
  apt-get install -y --no-install-recommends --no-remove g++-aarch64-linux-gnu qemu-user
fi

if [[ ! -f $sysroot/complete ]]; then
  lists=$sysroot/apt
  mkdir -p "$lists/partial" "$sysroot/debs"
  options=(-o APT::Architecture=arm64 -o APT::Architectures=arm64 -o Dir::State::Lists="$lists"
    -o APT::Sandbox::User=root)
  apt-get "${options[@]}" update
  (cd "$sysroot/debs" && apt-get "${options[@]}" download "${packages[@]}")
  for package in "$sysroot"/debs/*.deb; do dpkg -x "$package" "$sysroot"; done
  touch "$sysroot/complete"
fi

cmake --preset arm64
if [[ ${1:-} == --quick ]]; then
  cmake --build --preset arm64 --target same_bits_test
  ctest --preset arm64 -R AreTheSameWithEveryCompiler --no-tests=error
else
  cmake --build --preset arm64
  ctest --preset arm64 --no-tests=error
fi
