#!/usr/bin/env zsh
# SPDX-License-Identifier: GPL-3.0-or-later
# complete.zsh FOLDER LINE...: what an interactive zsh offers at the end of each
# line, with the completions of FOLDER; "== LINE" first, one offer a line.
folder=$1
shift
zmodload zsh/zpty
offers=$(mktemp) setup=$(mktemp)
trap 'rm -f $offers $setup' EXIT
cat >$setup <<END
PROMPT= RPROMPT= LISTMAX=10000
fpath=($folder \$fpath)
autoload -Uz compinit
compinit -u -D
# What completion functions add, as it is added; queries about it are not.
compadd () {
  if [[ \${@[1,(i)(-|--)]} == *-(O|A|D)\ * ]]; then
    builtin compadd "\$@"
    return
  fi
  typeset -a hits
  builtin compadd -A hits "\$@"
  print -rl -- \$hits >>$offers
  builtin compadd "\$@"
}
# Such functions are called once, unless they ask for it again.
tell-end () {
  print -r -- "end of offers" >>$offers
  comppostfuncs=(tell-end)
}
comppostfuncs=(tell-end)
bindkey '^I' list-choices
print -r -- ready >>$offers
END
await () { # PATTERN
  repeat 400; do
    [[ "$(<$offers)" != *$~1* ]] || return 0
    sleep 0.05
    zpty -rt z ignored 2>/dev/null
  done
  print -u2 "zsh: no answer to: $2"
  exit 1
}
zpty -b z zsh -f -i
zpty -w z "source $setup"
await ready setup
for line in "$@"; do
  : >$offers
  zpty -wn z $'\025'"$line"$'\t'
  await "end of offers" $line
  print -r -- "== $line"
  grep -v "^end of offers$" $offers
done
zpty -d z
