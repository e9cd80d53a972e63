#!/usr/bin/env bash
# Runs the tests of a filter in one process: run_suite.sh PROGRAM FILTER. If that process ends before
# its last test, every test runs again in a process of its own, so that each has a verdict. The exit
# code is 77 if all tests were skipped.
set -u
program=$1
filter=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# GoogleTest makes this file first and removes it last.
export TEST_PREMATURE_EXIT_FILE=$work/unfinished
"$program" --gtest_filter="$filter" | tee "$work/output"
status=${PIPESTATUS[0]}
if [ -e "$TEST_PREMATURE_EXIT_FILE" ]; then
  echo "$program ended with $status before its last test; every test runs alone now:"
  failed=()
  while read -r test; do
    rm -f "$TEST_PREMATURE_EXIT_FILE"
    status=0
    "$program" --gtest_filter="$test" --gtest_brief=1 || status=$?
    if [ -e "$TEST_PREMATURE_EXIT_FILE" ] || [ "$status" -ne 0 ]; then
      failed+=("$test (ended with $status)")
    fi
  done < <("$program" --gtest_list_tests --gtest_filter="$filter" |
    awk '/^[^ ]/ { suite = $1 } /^ / { print suite $1 }')
  printf 'FAILED: %s\n' "${failed[@]:-none alone, but all in one process}"
  exit 1
fi
if [ "$status" -eq 0 ] && grep -q '^\[  SKIPPED \]' "$work/output" &&
  ! grep -q '^\[       OK \]' "$work/output"; then
  exit 77
fi
exit "$status"
