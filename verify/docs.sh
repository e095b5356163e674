#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The API reference of what is installed: build/docs/html/index.html. A warning is an error; every type and every function
# has a docstring, members of a documented type may speak for themselves.
set -euo pipefail
cd "$(dirname "$0")/.."
bash verify/install.sh --docs
cmake --preset release >/dev/null
mkdir -p build/docs
{
  cat verify/doxygen/Doxyfile
  echo "INPUT = verify/doxygen/mainpage.md verify/subject/subject.h $(tr '\n' ' ' <build/release/installed_headers.txt)"
} | doxygen - 2>&1 | grep -v 'Member .* of \(class\|struct\) .* is not documented' >build/docs/warnings.txt || true
if [[ -s build/docs/warnings.txt ]]; then
  cat build/docs/warnings.txt >&2
  exit 1
fi
echo build/docs/html/index.html
