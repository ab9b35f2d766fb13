# SPDX-License-Identifier: GPL-3.0-or-later
# gcovr's CSV to a page: a table by folder, one by file.
function Row(name, lines, lines_hit, branches, branches_hit) {
  return sprintf("| %s | %d | %.1f %% | %d | %.1f %% |", name, lines,
                 lines ? 100 * lines_hit / lines : 100, branches,
                 branches ? 100 * branches_hit / branches : 100)
}
function Add(name) {
  lines[name] += $2; lines_hit[name] += $3
  branches[name] += $5; branches_hit[name] += $6
}
FNR > 1 {
  folder = $1
  sub("/[^/]*$", "", folder)
  Add(folder)
  Add("all")
  files = files "\n" Row($1, $2, $3, $5, $6)
  if (!(folder in seen)) order[++count] = folder
  seen[folder]
}
END {
  head = "lines | covered | branches | covered |\n|---|---|---|---|---|"
  print "# Coverage of the library by its tests\n"
  print "By `scripts/check.sh coverage` (" slice "), gcc's counters at -O1,"
  print "branches of exceptions left out. Branches are those of the compiler: an"
  print "assertion, a container's check and both ways out of every `&&` count.\n"
  print "| folder | " head
  order[++count] = "all"
  for (i = 1; i <= count; ++i) {
    f = order[i]
    print Row(f, lines[f], lines_hit[f], branches[f], branches_hit[f])
  }
  print "\n| file | " head files
}
