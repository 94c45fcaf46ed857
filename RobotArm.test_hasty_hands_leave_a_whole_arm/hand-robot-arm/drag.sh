#!/bin/sh
# Replays the hand. CHASLES names the program.
cd "$(dirname "$0")"
"${CHASLES:-chasles}" drag scene.json --body "upper arm" --goals hand.csv --out out.csv --page replay.html --margin 0.05 --friction 0.3 --lock hinge --lock-axis "0 0 1" --lock-point "0 0 0"
