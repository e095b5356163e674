#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs the Debian 12 packages that are missing; silent and quick when none is. Needs root or sudo only then. On a terminal
# apt-get shows what it does, elsewhere only if it fails.
#   verify/install.sh          what building and testing need
#   verify/install.sh --docs   also what the API reference needs
#   verify/install.sh --dev    also clang, the formatters and linters, the fuzzer's runtime, Vulkan for tests
set -euo pipefail

packages=(
  g++ cmake ninja-build                                     # build
  libosd-dev libcgal-dev libopenmesh-dev libembree-dev      # the tessellators audited; CGAL also judges watertightness
  libeigen3-dev libboost-dev libmpfr-dev libgmp-dev         # linear algebra and multiprecision
  libflint-dev libflint-arb-dev                             # certified enclosures
  libtbb-dev libcli11-dev libfmt-dev nlohmann-json3-dev     # threads, command line, text, JSON
  libhwy-dev                                                # SIMD with dispatch at run time
  libtinygltf-dev libassimp-dev                             # glTF input; the reader that checks what is written
  libmd-dev                                                 # digests of reports
  libgtest-dev libbenchmark-dev                             # tests, benchmarks
  dpkg-dev file                                             # the Debian package
  python3-jsonschema                                        # tests: the reports against their schema
  python3-dev pybind11-dev python3-numpy                    # the Python package
  libepoxy-dev libegl1 libgl1 libgl1-mesa-dri libpng-dev pkgconf  # OpenGL without a display, pictures
  valgrind python3-scipy                                    # exact instruction counts; statistics of timings
)
if [[ ${1:-} == --dev ]]; then
  packages+=(clang libclang-rt-14-dev clang-format clang-tidy cppcheck codespell gcovr ccache)
  packages+=(mesa-vulkan-drivers libvulkan-dev glslang-tools)  # the engine's shaders as other drivers compile them
elif [[ ${1:-} == --docs ]]; then
  packages+=(doxygen)
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done
[[ ${#missing[@]} -eq 0 ]] && exit 0

root=()
if [[ $(id -u) -ne 0 ]]; then
  command -v sudo >/dev/null || {
    echo "verify/install.sh: run as root or install sudo; missing packages: ${missing[*]}" >&2
    exit 2
  }
  root=(sudo)
fi
get() {
  "${root[@]}" apt-get update -q &&
    "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"
}
echo "Installing Debian packages: ${missing[*]} ..." >&2
if [[ -t 2 ]]; then
  get >&2 || exit 2
else
  log=$(mktemp)
  trap 'rm -f "$log"' EXIT
  get >"$log" 2>&1 || { cat "$log" >&2; exit 2; }
fi
echo "Installed, in $SECONDS s." >&2
