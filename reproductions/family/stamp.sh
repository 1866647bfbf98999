# What an earlier pass left is gone on with where it was the same pass, and only there: sourced by the reproductions' scripts.

# begin_in FOLDER GRACILIS WORDS...: makes the folder for a pass by this program and these options. What another pass left there
# goes; other files are nobody's to take away.
begin_in() {
  local folder=$1 gracilis=$2 stamp=$1/made_by.txt made_by
  shift 2
  made_by=$("$gracilis" --version)
  made_by="$* by ${made_by//$'\n'/, }"
  if [[ -f $stamp ]]; then
    [[ $(<"$stamp") == "$made_by" ]] || {
      echo "$folder: made anew, for it was made with $(<"$stamp")" >&2
      find "$folder/" -mindepth 1 -delete
    }
  elif [[ -n $(ls -A "$folder" 2>/dev/null) ]]; then
    echo "$folder holds files that are not from here, or from an older version: remove it, or take another folder by --out" >&2
    exit 2
  fi
  mkdir -p "$folder"
  echo "$made_by" >"$stamp"
}

# is_finished FOLDER: whether a run is complete, and not killed half way.
is_finished() {
  grep -qs '^  "status": "complete"' "$1/run.json"
}
