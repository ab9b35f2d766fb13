# SPDX-License-Identifier: GPL-3.0-or-later
# Shows Doxygen the headers' comments: a comment above a declaration is its
# documentation, one behind it (and the lines that go on below, as far in) too.
# What stands indented after an empty line is code or a formula, no list: it stays
# as it is written.  A line that begins with > is no quotation.
/^\/\/ SPDX-License-Identifier/ { print ""; next }
/^ *\/\/( |$)/ {
  column = index($0, "//")
  text = substr($0, column + 2)
  is_code = (after_empty || is_code) && text ~ /^   +[^ ]/ && text !~ /^ +[-0-9]+[.]? /
  after_empty = text == ""
  if (is_code) sub(/\/\//, "//    ")
  if (text ~ /^ *>/) sub(/>/, "\\>")
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
