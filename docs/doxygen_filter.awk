# SPDX-License-Identifier: GPL-3.0-or-later
# Shows Doxygen the headers' comments: a comment above a declaration is its
# documentation, one behind it (and the lines that go on below, as far in) too.
/^\/\/ SPDX-License-Identifier/ { print ""; next }
/^ *\/\/( |$)/ {
  column = index($0, "//")
  if (behind && column == behind) {
    sub(/\/\//, "///<")
  } else {
    behind = 0
    sub(/\/\//, "///")
  }
  print
  next
}
/[;,{)] +\/\/ / {
  match($0, / \/\/ /)
  behind = RSTART + 1
  sub(/ \/\/ /, " ///< ")
  print
  next
}
{ behind = 0; print }
