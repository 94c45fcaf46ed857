#!/bin/sh
# same.sh A B [THREADS]: checks that program A (on one thread) and program B print the same.
expected=$("$1") || exit $?
found=$("$2" ${3:-}) || exit $?
if [ "$expected" = "$found" ]; then
    echo "$found"
else
    printf '%s\n' "DIFFERENT BITS" "$1:" "$expected" "$2 ${3:-}:" "$found"
    exit 1
fi
