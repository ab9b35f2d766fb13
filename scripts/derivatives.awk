# SPDX-License-Identifier: GPL-3.0-or-later
# gcov's text (-t -b -c -m) of sources to a table of the functions that compute
# derivatives or take a step by them, with the branches that no test takes.
function Flush(   i, hit, missed, short, last) {
  short = name
  gsub(/\(anonymous namespace\)::/, "", short)
  sub(/\(.*/, "", short)
  sub(/^phongpd::/, "", short)
  if (source !~ /^(core|constraints|planners)\//) return
  if (short !~ wanted || short ~ /</) return
  if ((source, at) in seen) return
  seen[source, at]
  if (name ~ /\{lambda/) short = short ", inner"
  for (i = 1; i <= count; ++i) {
    if (taken[i] > 0) {
      ++hit
    } else if (text[i] != last) {
      last = text[i]
      missed = missed (missed == "" ? "" : "<br>") "`" last "`"
    }
  }
  printf "| %s | %s | %d | %d | %s |\n", source, short, count, hit, missed
}
BEGIN {
  wanted = "(Gradient|Jacobian|Slope|Hessian|Jet|UnitNormal|Lengths" \
    "|Local|SafeFraction|RefineHit|Newton|ProjectOnTangentPlanes" \
    "|CriticalPoints|RootInBracket|::Constraints" \
    "|NonPenetrationConstraint::Evaluate)$"
  print "## Derivatives\n"
  print "Functions that compute derivatives or step by them; with each branch"
  print "that no test takes its line. Branches in Eigen expressions written there"
  print "count, those of exceptions do not.\n"
  print "| file | function | branches | taken | never taken |"
  print "|---|---|---|---|---|"
}
/^ *-: *0:Source:/ {
  Flush()
  name = ""
  source = $0
  sub(/.*Source:(.*\/\.\.\/)*/, "", source)
  sub(/^\.\.\//, "", source)
  next
}
/^function / {
  Flush()
  name = $0
  sub(/^function /, "", name)
  sub(/ called [0-9]+ returned.*/, "", name)
  count = at = 0
  next
}
/^branch / {
  if ($0 !~ /\(throw\)/) {
    taken[++count] = ($3 == "taken") ? $4 : 0
    text[count] = line
  }
  next
}
/^ *[-#=0-9*]+: *[0-9]+:/ {
  line = $0
  if (!at) { at = $0; sub(/^[^:]*: */, "", at); sub(/:.*/, "", at) }
  sub(/^[^:]*:[^:]*: */, "", line)
  gsub(/\|/, "\\|", line)
}
END { Flush() }
