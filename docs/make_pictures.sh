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

# Fracture at rest (docs/pictures/verification).
for row in single_edge_crack bend_specimen compact_tension clamped_strip pressurised_crack end_notched_flexure spinning_ring; do run $row $row verification; done
run brazilian brazilian fracture
draw single_edge_crack --quantity stress_yy --frame -1 --magnify 30 --window "-5 mm" "35 mm" "-25 mm" "25 mm" --width 500 --output docs/pictures/verification/single_edge_crack.png
draw bend_specimen --quantity stress_xx --frame -1 --magnify 30 --width 800 --output docs/pictures/verification/bend_specimen.png
draw compact_tension --quantity stress_yy --frame -1 --magnify 100 --width 600 --output docs/pictures/verification/compact_tension.png
draw clamped_strip --quantity stress_yy --time "20 us" "80 us" "160 us" --panel 3x1 --magnify 100 --width 600 --output docs/pictures/verification/clamped_strip.png
draw pressurised_crack --quantity stress_yy --frame -1 --magnify 200 --window 0 "60 mm" "-50 mm" "50 mm" --width 500 --output docs/pictures/verification/pressurised_crack.png
draw brazilian --quantity stress_xx --frame -1 --magnify 2000 --range "-10 MPa" "10 MPa" --width 600 --output docs/pictures/verification/brazilian.png
draw end_notched_flexure --quantity stress_xx --frame -1 --magnify 100 --width 800 --output docs/pictures/verification/end_notched_flexure.png
draw spinning_ring --quantity von_mises --frame 1 3 5 7 --panel 2x2 --width 500 --output docs/pictures/verification/spinning_ring.png
mkdir -p docs/pictures/verification
standing="2*500e6*sqrt(5944*max(time - 3.3645e-4, 0)*0.4/3.14159265)/0.7"  # Freund's K_I of a crack that stands
run freund freund fracture
draw freund --history "K_I [Pa m^(1/2)] = K_I.crack.end" "Freund [Pa m^(1/2)] = $standing" --output docs/pictures/verification/freund.png
run chen chen fracture --set time.end='"13 us"'
draw chen --history "K_I [Pa m^(1/2)] = K_I.crack.end" \
  "finite elements [Pa m^(1/2)] = $(/usr/bin/python3 tests/compare_history.py --as-formula tests/verification/references/chen.csv --scale 34.73e6)" \
  --window "3 us" "13 us" "-20 MPa m^(1/2)" "100 MPa m^(1/2)" --output docs/pictures/verification/chen.png
run forced_growth forced_growth verification
draw forced_growth --history "J [J/m2] = J.crack.end" "standing tip [J/m2] = ($standing)^2*0.91/210e9" \
  "running tip [J/m2] = 0.516*($standing)^2*0.91/210e9*if(time > 5.047e-4, 1, 0)" --output docs/pictures/verification/forced_growth.png
run john_shah john_shah fracture
draw john_shah --quantity stress_xx --time "0.85 ms" --magnify 50 --range "-6 MPa" "6 MPa" --output docs/pictures/verification/john_shah.png
run bridged_dcb bridged_dcb verification
draw bridged_dcb --history "J_far [J/m2] = J_far.crack.end" "elastic foundation [J/m2] = 4.518*min(time/1e-3, 1)^2" \
  --output docs/pictures/verification/bridged_dcb.png
run r_curve r_curve fracture
draw r_curve --against crack_length.crack --history J_far.crack.end J.crack.end "toughness and bridges [J/m2] = 300" \
  --output docs/pictures/verification/r_curve.png
run strip_yield strip_yield verification
draw strip_yield --quantity stress_yy --frame -1 --magnify 100 --window "-1 mm" "30 mm" "-12 mm" "12 mm" --output docs/pictures/verification/strip_yield.png
run nucleation nucleation fracture
draw nucleation --quantity stress_yy --magnify 20 --time "400 us" "420 us" "440 us" "480 us" --panel 2x2 --output docs/pictures/nucleation.png
run kalthoff kalthoff fracture --set 'grid.cell="1 mm"'
draw kalthoff --quantity velocity_x --range "-20 m/s" "60 m/s" --time "30 us" "50 us" "70 us" "90 us" --panel 2x2 --width 500 --output docs/pictures/verification/kalthoff.png
run wing_crack wing_crack fracture
draw wing_crack --quantity stress_yy --frame -1 --magnify 30 --window "-40 mm" "40 mm" "-50 mm" "50 mm" --width 500 --output docs/pictures/verification/wing_crack.png
