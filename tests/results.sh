# For tests/run.sh and tests/sanitizers.sh: runs test programs and counts what they report. Every program leaves
# FOLDER/results/NAME.xml (GoogleTest's format); checks without GoogleTest leave one through record.

launcher=()

# record FOLDER NAME CODE: one check that passed (0) or failed.
record() {
  local failures=0
  [ "$3" = 0 ] || failures=1
  mkdir -p "$1/results"
  printf '<testsuites tests="1" failures="%d" disabled="0" errors="0" name="%s"></testsuites>\n' "$failures" "$2" \
    >"$1/results/$2.xml"
}

# record_skip FOLDER NAME REASON
record_skip() {
  mkdir -p "$1/results"
  printf '<testsuites tests="1" failures="0" disabled="0" errors="0" name="%s">
<testcase name="%s" classname="Program" result="skipped">
<skipped message="%s"></skipped>
</testcase></testsuites>\n' "$2" "$2" "$3" >"$1/results/$2.xml"
}

# run_tests FOLDER CTEST-OPTIONS...: ctest, under `launcher` if that is set. A failure that a program's
# results do not show (a crash, a sanitizer's report at exit, a timeout) is recorded as one more.
run_tests() {
  local folder=$1 code=0 failed=$1/Testing/Temporary/LastTestsFailed.log name
  shift
  rm -rf "$failed"
  "${launcher[@]}" ctest --test-dir "$folder" --parallel "$jobs" --output-on-failure "$@" || code=$?
  [ -e "$failed" ] || return "$code"
  while IFS=: read -r _ name; do
    if ! grep -qs '<testsuites [^>]*failures="[1-9]' "$folder/results/$name.xml"; then
      record "$folder" "$name (crash, timeout or sanitizer report: see above)" 1
    fi
  done <"$failed"
  return "$code"
}

# summarize FOLDER...: what was skipped and why, what failed, and as the last line "N passed, N failed". Two reasons are
# good: files of other programs that are not beside this checkout (missing_asset in support/paths.h), and a validator that
# cannot be installed. A test that is skipped for another one has failed: scenes/setup.sh installs all the rest.
summarize() {
  local folder files=()
  for folder in "$@"; do
    if compgen -G "$folder/results/*.xml" >/dev/null; then files+=("$folder"/results/*.xml); fi
  done
  [ ${#files[@]} -gt 0 ] || { echo "0 passed, 1 failed"; return 1; }
  local assets
  assets=$([ -d "$root/../shared/assets" ] && echo 1 || echo 0)
  awk -v assets="$assets" '
    function attribute(name, match_at) {
      if (!match($0, " " name "=\"[^\"]*\"")) return ""
      return substr($0, RSTART + length(name) + 3, RLENGTH - length(name) - 4)
    }
    /<testsuites / {
      tests += attribute("tests"); disabled += attribute("disabled"); bad = attribute("failures") + attribute("errors")
      failed += bad
      if (bad > 0) {
        file = FILENAME
        sub(/^.*\/build/, "build", file); sub(/\/results\//, "/", file); sub(/\.xml$/, "", file)
        print "FAILED: " file
      }
    }
    /<testcase / { test = attribute("classname") "." attribute("name") }
    /<testcase / && /result="skipped"/ { ++skipped; waiting = test }
    /<skipped message=/ && waiting != "" {
      message = attribute("message"); gsub(/&#x0A;|&#xA;/, " ", message); sub(/^[^ ]*:[0-9]+ /, "", message)
      sub(/^files of other programs are not here: .*/, "files of other programs are not here", message)
      if (!(message ~ /^files of other programs are not here/ && !assets) && message !~ /gltf-validator|scenes\/setup.sh can/) {
        ++unexpected
        print "FAILED: " waiting " must not be skipped here: " message
      }
      reasons[message] = reasons[message] == "" ? waiting : reasons[message] ", " waiting; waiting = ""
    }
    END {
      for (reason in reasons) print "skipped (" reason "): " reasons[reason]
      printf "%d passed, %d failed\n", tests - failed - skipped - disabled, failed + unexpected
      exit failed + unexpected > 0
    }' "${files[@]}"
}
