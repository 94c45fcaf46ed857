#!/bin/sh
# install_dependencies.sh on a simulated system: replacements of system commands record their arguments.
set -eu

here=$(cd "$(dirname "$0")" && pwd)
script=$here/../../tools/install_dependencies.sh
set -- cat dirname env
. "$here/pretended.sh"

# run ARGUMENTS: runs the script, and sets `asked` to its calls of apt-get and sudo.
run() {
    run_pretended "$script" "$@"
    asked=$(grep -E '^(apt-get|sudo)' "$folder/log" || true)
}

run --list check fuzz python bench tidy format
everything=$(printf 'echo installed %s\n' $output)

run --list check
expect "the list names the compiler and the test framework" 'case $output in *g++*libgtest-dev*) ;; *) false ;; esac'

expect "without npm and a browser, the list names them" 'case $output in *nodejs\ npm*chromium*) ;; *) false ;; esac'

pretend npm ''
pretend chromium ''
run --list check
expect "those from elsewhere will do" 'case $output in *npm*|*chromium*) false ;; esac'
rm "$folder/bin/npm" "$folder/bin/chromium"

run --list demo
expect "the demo needs no npm" \
    'case $output in *npm*) false ;; *g++*libeigen3-dev*) ;; *) false ;; esac'

run --list format
expect "the layout needs its tool and nothing else" 'case $output in clang-format-[0-9]*\ *) false ;; clang-format-*) ;; *) false ;; esac'

run --list
default=$output
run --list install
expect "without a group, everything that is installed" '[ "$output" = "$default" ] && case $output in *zlib1g-dev*npm*) ;; *) false ;; esac'

run --list fuzz
expect "fuzzing needs the compiler and its runtime" 'case $output in *clang-*libclang-rt-*) ;; *) false ;; esac'

run --list python
expect "the package needs environments and headers" 'case $output in *python3-venv*python3-dev*) ;; *) false ;; esac'

run --list bench
expect "benchmarks need Python's environments and Rust" 'case $output in *python3-venv*cargo*) ;; *) false ;; esac'

pretend cargo ''
run --list bench
expect "Rust from elsewhere will do" 'case $output in *cargo*) false ;; esac'
rm "$folder/bin/cargo"

run check
expect "elsewhere than on Debian: one line, no failure" \
    '[ $status -eq 0 ] && [ "$(printf "%s\n" "$output" | wc -l)" -eq 1 ] && [ -n "$output" ]'

pretend apt-get ''
pretend id 'echo 0'
pretend dpkg-query "$everything"
run check fuzz python bench tidy format
expect "nothing missing: silent, and the package lists are left alone" '[ $status -eq 0 ] && [ -z "$output$asked" ]'

pretend dpkg-query "$(printf '%s\n' "$everything" | grep -v -e 'installed libfmt-dev$')
echo config-files libfmt-dev
exit 1"
run check
expect "one missing, as root: update, then that one" \
    'case $asked in "apt-get -q update"*install*" libfmt-dev") ;; *) false ;; esac'

run bench nonsense
expect "an unknown group is refused" '[ $status -eq 2 ] && [ -z "$asked" ]'

pretend id 'echo 1000'
run check
expect "neither root nor sudo: says what to run" \
    '[ $status -eq 1 ] && [ -z "$asked" ] && case $output in *"apt-get install libfmt-dev") ;; *) false ;; esac'

pretend sudo '"$@"'
run check
expect "with sudo: the same, through sudo" 'case $asked in "sudo apt-get"*"sudo env"*install*) ;; *) false ;; esac'

pretend id 'echo 0'
pretend dpkg-query 'exit 1'
run --list check
wanted=$output
run check
expect "nothing installed: everything is asked for" 'case $asked in *"install $wanted") ;; *) false ;; esac'

pretend apt-get 'exit 100'
run check
expect "a failed installation stops the build" '[ $status -ne 0 ]'

echo "every case as expected"
