#!/usr/bin/env zsh
# The completion as zsh asks for it: completion.zsh SCRIPT PROGRAM. A shell on a terminal of its own
# types each line and presses the key; what it would show is caught where it is handed to the editor.
script=$1
program=$2
work=$(mktemp -d)
trap 'rm -rf $work' EXIT
cd $work || exit 1
mkdir -p scenes out/scene/{gauss8,midpoint,no-result}
touch orbit.toml other.toml orbit.csv out/scene/{gauss8,midpoint}/jet.csv
failures=0

zsh -n $script || exit 1
zmodload zsh/zpty || exit 77

zpty shell zsh -f -i
# The answers to one line, a word each, sorted.
read -r -d '' preparation <<'SHELL'
PROMPT= RPROMPT=
unsetopt prompt_cr prompt_sp zle_bracketed_paste 2>/dev/null
autoload -Uz compinit && compinit -u -D
zstyle ':completion:*' completer _complete
zstyle ':completion:*' list-dirs-first false
compadd() {
  local -a found
  if [[ ${@[1,(i)(-|--)]} != *-(O|A|D)\ * ]]; then
    builtin compadd -A found "$@"
    print -rl -- $found >>answers
  fi
  builtin compadd "$@"
}
# Nothing is shown or put into the line, or the next question would begin with this one's answers.
find_answers() { _main_complete; compstate[insert]= compstate[list]= }
zle -C find-answers complete-word find_answers
answer() {
  BUFFER=$(<question) CURSOR=$#BUFFER
  : >answers
  zle find-answers
  BUFFER=
  mv answers answered
}
zle -N answer
bindkey '^T' answer
SHELL
print -r -- "$preparation" >preparation
zpty -w shell "source ./preparation; source ${(q)script}; rm preparation; touch ready"
for ((i = 0; i < 300; ++i)); do [[ -e ready ]] && break; sleep 0.1; done
[[ -e ready ]] || { print 'zsh does not start'; exit 1 }
rm ready

# expect ANSWERS LINE: what the last word of the line is completed to.
expect() {
  print -rn -- "$2" >question
  zpty -w -n shell $'\C-t'
  local i answers
  for ((i = 0; i < 300; ++i)); do [[ -e answered ]] && break; sleep 0.05; done
  answers=$(sort -u answered | grep . | paste -sd ' ')
  rm -f answered
  if [[ $answers != $1 ]]; then
    print -r -- "$2"$'\n'"  is completed to  $answers"$'\n'"  in place of      $1"
    ((++failures))
  fi
}

names=$($program --help | sed -n '/^Subcommands:/,$ s/^  \([a-z][a-z-]*\) .*/\1/p' |
  sort | paste -sd ' ')
expect "$names" 'hamjet '
expect "$names" 'hamjet help '
for command in ${=names}; do
  choices=$($program $command --help | sed -n 's/^  \(-[-a-z,]*\).*/\1/p' | tr , '\n' |
    sort | paste -sd ' ')
  expect "$choices" "hamjet $command -"
done
expect 'orbit.toml other.toml out scenes' 'hamjet run '
expect 'orbit.toml' 'hamjet run --json -o results --set jet.order=6 or'
expect 'out scenes' 'hamjet run orbit.toml -o '
expect '' 'hamjet run orbit.toml --set '
expect 'orbit.csv orbit.toml' 'hamjet eval out/scene --deviations orb'
expect 'pdf png' 'hamjet compare orbit.toml --plots '
expect 'pdf png' 'hamjet compare orbit.toml --plots='
expect 'integrators keys kinds systems' 'hamjet list '
expect 'geo gto leo molniya pair' 'hamjet init '
expect 'RTN canonical curvilinear element-differences inertial relative-elements' 'hamjet eval out/scene --frame '
expect 'gauss8 midpoint' 'hamjet eval out/scene --run '
expect 'gauss8' 'hamjet transfer orbit.toml --jet out/scene/ --run g'
zpty -d shell
((failures == 0))
