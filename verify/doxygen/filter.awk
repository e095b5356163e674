# SPDX-License-Identifier: MIT
# The comments of this project as Doxygen reads them: "///   name   meaning" is a list item, a comment behind a declaration is that
# declaration's, and so is the one above it in C.
FILENAME ~ /\.md$/ { print; next }
/^ *\/\/\/ / {
  if (match($0, /\/\/\/ {2,4}[A-Za-z_][A-Za-z0-9_, ]* {2,}/) && $0 !~ /\/\/\/ {5}/) {
    item = substr($0, RSTART + 3, RLENGTH - 3)
    rest = substr($0, RSTART + RLENGTH)
    gsub(/^ +| +$/, "", item)
    print substr($0, 1, RSTART - 1) "/// - **" item "** " rest
    next
  }
}
{
  behind = continued && match($0, /^ *\/\/ /)
  continued = behind
  if (behind) sub(/\/\/ /, "///< ")
  else if ($0 !~ /^ *\/\// && match($0, /[;,{}A-Za-z0-9)] +\/\/ /)) {
    sub(/ \/\/ /, " ///< ")
    continued = 1
  }
  if (FILENAME ~ /subject\.h$/ && FNR > 1) {
    if ($0 ~ /[;,] *\/\* /) sub(/\/\* /, "/**< ")
    else if ($0 ~ /^ *\/\*/) sub(/\/\*/, FNR == 2 ? "/** @file" : "/**")
  }
  print
}
