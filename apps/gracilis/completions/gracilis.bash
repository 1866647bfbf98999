# Completion for bash: the program says what may stand there ('gracilis complete LINE').
_gracilis() {
  local line=${COMP_LINE:0:COMP_POINT} current=${COMP_WORDS[COMP_CWORD]} begun before word
  # Readline breaks words at '=' and ':', too, and replaces only what comes after.
  [[ $current == [=:] ]] && current=
  begun=${line##*[[:space:]]}
  before=${begun%"$current"}
  COMPREPLY=()
  while IFS=$'\t' read -r word _; do
    [[ $word == *[/=.,] ]] && compopt -o nospace 2>/dev/null
    [[ $begun == [\"\']* ]] || printf -v word %q "$word"
    COMPREPLY+=("${word#"$before"}")
  done < <("$1" complete "$line" 2>/dev/null)
} && complete -F _gracilis gracilis
