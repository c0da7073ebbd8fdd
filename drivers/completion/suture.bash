# Bash completion for Suture's programs. The options are read from the program's --help.
_suture() {
  local word=${COMP_WORDS[COMP_CWORD]} before="" program=${COMP_WORDS[0]}
  ((COMP_CWORD > 0)) && before=${COMP_WORDS[COMP_CWORD - 1]}
  COMPREPLY=()
  local help
  help=$("$program" --help 2>/dev/null) || return 0
  # "--format TEXT:{text,xml,markdown}": the values of an option with a fixed list
  local values
  values=$(sed -n "s/^ .*${before:-none} [A-Z]*:{\([^}]*\)}.*/\1/p" <<<"$help")
  if [[ $before == -* && -n $values ]]; then
    mapfile -t COMPREPLY < <(compgen -W "${values//,/ }" -- "$word")
  elif [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(grep -oE '(^|[ ,])--?[a-z][a-z-]*' <<<"$help" | tr -d ' ,' | sort -u)" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
    compopt -o filenames 2>/dev/null
  fi
}
complete -F _suture suture_solve suture_study suture_partition suture_schema suture_new suture_plot suture_study_plot suture_convert
