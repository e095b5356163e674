# SPDX-License-Identifier: MIT
# Completion of limitcheck in bash; verify/package/_limitcheck and limitcheck.fish ask it, too. Commands, options and choices are read from the program's own --help, so there is no
# second list of them.
_limitcheck() {
  local program=${COMP_WORDS[0]} word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}
  local command='' help='' words='' i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    [[ ${COMP_WORDS[i]} == -* ]] || { command=${COMP_WORDS[i]}; break; }
  done
  COMPREPLY=()
  if [[ -z $command ]]; then
    help=$("$program" --help 2>/dev/null) || return
    [[ $word == -* ]] || words=$(sed -n '/^Subcommands:/,/^$/s/^  \([a-z][a-z-]*\) .*/\1/p' <<<"$help")
  else
    help=$("$program" "$command" --help 2>/dev/null) || return
    case $previous in
      --json | --junit | --sarif | --markdown | --rerun | --save-baseline | --html | --baseline | --waivers | --control | --tessellation | --provenance | --per-vertex | -o | --output) ;;
      --explain) words="all $("$program" audit --explain all 2>/dev/null | sed -n 's/^\([a-z][a-z-]*\)$/\1/p')" ;;
      --*) words=$(sed -n "s/^  [^ ]*$previous[ ,][^{]*:{\([^}]*\)}.*/\1/p" <<<"$help" | tr , ' ') ;;
      *)
        [[ $word == -* ]] || case $command in
          audit | eval | generate | tessellate) words=$("$program" generate --list 2>/dev/null | sed 's/[^a-z-].*//') ;;&
          audit | hunt) # the complaint about an unknown subject lists the subjects there are
            [[ $previous != "$command" ]] ||
              words=$("$program" audit '?' 2>&1 | sed -n 's/.* there are: \(.*\), shared libraries.*/\1/p' | tr -d ,) ;;
          bench) words=$(sed -n 's/^  {\(.*\)}$/\1/p' <<<"$help" | tr , ' ') ;;
        esac
        ;;
    esac
  fi
  if [[ $word == -* ]]; then
    words=$(sed -n 's/^  \(-.*\)/\1/; T; s/ Needs:.*//; s/   *[^ -].*//; p' <<<"$help" | grep -o -e '-[a-z-]*')
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  # Nothing of ours: files, as `complete -o default` does.
}
# Run as a script it says what it would offer for the last of its arguments: zsh and fish ask it.
if [[ ${BASH_SOURCE[0]} == "$0" ]]; then
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
  _limitcheck
  ((${#COMPREPLY[@]} == 0)) || printf '%s\n' "${COMPREPLY[@]}"
else
  complete -o default -F _limitcheck limitcheck
fi
