#!/usr/bin/env bash
# Data flows one way: a room includes only rooms that stand before it here; and what people see leaves by one door. Prints
# every arrow that goes back and every other door, and fails.
set -euo pipefail
cd "$(dirname "$0")/.."
order=(base
  sim/mesh sim/import sim/body sim/levels sim/linear sim/pass sim/force sim/filter sim/step sim/contact sim/limit sim/drawn
  render/image render/gl render/paper render/frame
  cli/text cli/yaml cli/scene cli/drawn cli/page cli/cache cli/run cli/cluster cli/study cli/golden cli/command)
# What a library may not see although it stands before it: the scene steps without pictures, the pictures see a body's
# drawn surface and nothing else of the physics.
forbidden=('cli/(text|yaml|scene) render/(gl|paper|frame)' 'render/[a-z]+ sim/(mesh|import|body|levels|linear|pass|force|filter|step|limit)')

declare -A place
for k in "${!order[@]}"; do place[${order[$k]}]=$k; done
room_of() { dirname "$1"; }
faults=0 arrows=0
while read -r file; do
  from=$(room_of "$file")
  [ "${place[$from]+known}" ] || { echo "$file: '$from' is no room; give it a place in tests/rooms.sh"; faults=$((faults + 1)); continue; }
  while read -r included; do
    to=$(room_of "$included") arrows=$((arrows + 1))
    if [ ! "${place[$to]+known}" ] || [ "${place[$to]}" -gt "${place[$from]}" ]; then
      echo "$file includes $included: $from stands before $to"
      faults=$((faults + 1))
    fi
    for rule in "${forbidden[@]}"; do
      if [[ "$from $to" =~ ^$rule$ ]]; then
        echo "$file includes $included: $from does not see $to"
        faults=$((faults + 1))
      fi
    done
  done < <(sed -n 's/^#include "\(\(base\|sim\|render\|cli\)\/[^"]*\)".*/\1/p' "$file")
done < <(find base sim render cli -name '*.h' -o -name '*.cpp' | sort)
# cli/text/terminal lets nothing but text out; the lines that base/announcement writes have gone through it.
while read -r use; do
  echo "$use: print with cli/text/terminal.h"
  faults=$((faults + 1))
done < <(grep -rnE 'fmt::print\(|std::(cout|cerr|puts|printf)\b|, std(out|err)\)' base sim render cli --include='*.cpp' --include='*.h' |
         grep -vE '^cli/text/terminal\.cpp:' | cut -d: -f1,2)
echo "$arrows includes between ${#order[@]} rooms, $faults of them wrong"
[ "$arrows" -gt 0 ] && [ "$faults" -eq 0 ]
