#!/usr/bin/env fish
# The completion as fish asks for it: completion.fish SCRIPT PROGRAM
set script $argv[1]
set program $argv[2]
set work (mktemp -d)
cd $work; or exit 1
mkdir -p scenes out/scene/gauss8 out/scene/midpoint out/scene/no-result
touch orbit.toml other.toml orbit.csv out/scene/{gauss8,midpoint}/jet.csv
set failures 0

fish -n $script; or exit 1
source $script; or exit 1

# expect ANSWERS LINE: what the last word of the line is completed to.
function expect
    set answers (complete -C "$argv[2]" | string split -f1 \t | sort | string join ' ')
    if test "$answers" != "$argv[1]"
        printf '%s\n  is completed to  %s\n  in place of      %s\n' "$argv[2]" "$answers" "$argv[1]"
        set failures (math $failures + 1)
    end
end

set commands ($program --help | sed -n '/^Subcommands:/,$ s/^  \([a-z][a-z-]*\) .*/\1/p' | sort)
test (count $commands) -ge 11; or exit 1
expect "$commands" 'hamjet '
expect "$commands" 'hamjet help '
expect '--help --version' 'hamjet --'
for command in $commands
    set options ($program $command --help | sed -n 's/^  \(-[-a-z,]*\).*/\1/p' | tr , '\n' |
        grep -- -- | sort)
    expect "$options" "hamjet $command --"
end
expect 'orbit.toml other.toml out/ scenes/' 'hamjet run '
expect 'orbit.toml' 'hamjet run --json -o results or'
expect 'out/ scenes/' 'hamjet run orbit.toml -o '
expect '' 'hamjet run orbit.toml --set '
expect 'orbit.csv orbit.toml' 'hamjet eval out/scene --deviations orb'
expect 'pdf png' 'hamjet compare orbit.toml --plots '
expect '--plots=pdf --plots=png' 'hamjet compare orbit.toml --plots=p'
expect 'integrators keys kinds systems' 'hamjet list '
expect 'geo gto leo molniya pair' 'hamjet init '
expect 'RTN canonical curvilinear element-differences inertial relative-elements' 'hamjet eval out/scene --frame '
expect 'gauss8 midpoint' 'hamjet eval out/scene --run '
expect 'gauss8' 'hamjet transfer orbit.toml --jet out/scene/ --run g'
rm -r $work
test $failures -eq 0
