#!/usr/bin/env bash
# Runs the examples at full resolution and draws every picture of the documentation: docs/make_pictures.sh [FOLDER FOR RESULTS]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
results=${1:-results}
run() { ./run.sh "examples/${3:-paper}/$1.toml" --output "$results/$2" --force --quiet --no-check "${@:4}"; }
draw() { ./run.sh draw "$results/$1" "${@:2}"; }

run dcb dcb
draw dcb --quantity stress_xx --magnify 5 --frame -1 --title "Double cantilever beam at rest, opened five times" --output docs/pictures/dcb.png
run disks disks
draw disks --quantity stress_yy --palette grey --symmetric --time 0 "6 ms" "12.5 ms" "26 ms" --panel 2x2 --output docs/pictures/disks.png
run five_disks five_disks
draw five_disks --fringes --frame -1 --output docs/pictures/five_disks.png
for update in usl musl usf usavg; do run beam_impact "beam_$update" paper --set "method.stress_update=$update"; done
draw beam_usavg --quantity stress_xx --panel 3x2 --output docs/pictures/beam.png
draw beam_usavg --history total_energy --compare "$results"/beam_{usf,musl,usl} --output docs/pictures/beam_energy.png
run composite composite contact
draw composite --quantity stress_xx --time "0.05 ms" "0.1 ms" --panel 2x1 --magnify 10 --output docs/pictures/composite.png
run cohesive_dcb cohesive_dcb contact
draw cohesive_dcb --quantity stress_yy --magnify 3 --frame -1 --output docs/pictures/cohesive_dcb.png
draw cohesive_dcb --against "crack_length [m] = (1.5*0.83333*0.4*max(time - 5e-4, 0)/max(reaction_y.top, 0.1))^(1/3)" \
  --history "energy_release_rate [J/m2] = reaction_y.top^2*crack_length^2/(1e-3*0.83333)" "toughness [J/m2] = 500" \
  --window "56 mm" "85 mm" 0 "600 J/m2" --title "R-curve of a cohesive double cantilever beam" --output docs/pictures/r_curve.png
run hertz hertz contact
draw hertz --profile x --quantity stress_yy --mean --window "-2 mm" "2 mm" "-0.3 mm" "0.1 mm" \
  --over "Hertz = -59.14e6*sqrt(max(0, 1 - (x/1.0764e-3)^2))" --output docs/pictures/hertz.png
run incline incline contact
draw incline --quantity velocity_x --time 0 "40 ms" "80 ms" "100 ms" --panel 2x2 --output docs/pictures/incline.png
run five_disks_friction five_disks_friction contact
draw five_disks_friction --fringes --frame -1 --output docs/pictures/five_disks_friction.png
run indenter indenter contact
draw indenter --quantity stress_xx --frame -1 --output docs/pictures/indenter.png
run nucleation nucleation fracture
draw nucleation --quantity stress_yy --magnify 20 --time "400 us" "420 us" "440 us" "480 us" --panel 2x2 --output docs/pictures/nucleation.png
