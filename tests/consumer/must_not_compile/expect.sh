#!/bin/sh
# expect.sh REASON COMPILER...: the command succeeds, and with -DMISUSE it fails with a message that matches REASON.
reason=$1
shift

if ! "$@"; then
    echo "the proper use does not compile, so the failure of the misuse would prove nothing"
    exit 1
fi
if message=$("$@" -DMISUSE 2>&1); then
    echo "the misuse compiles"
    exit 1
fi
if ! printf '%s\n' "$message" | grep -Eq "$reason"; then
    printf '%s\n' "the misuse fails for another reason than \"$reason\":" "$message"
    exit 1
fi
