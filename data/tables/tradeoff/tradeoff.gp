if (!exists('picture')) picture = 'tradeoff.svg'
data = 'tradeoff.dat'
set encoding utf8
set terminal svg size 960,520 font 'DejaVu Sans,13' background 'white' linewidth 1.3
set output picture
set multiplot layout 1,2
set logscale xy
set format y '%.0e'
set yrange [1e-10/2:*]
set xlabel 'cost of a sample over that of the strict settings'
set ylabel 'error of a state, relative (at least 1e-10)'
set title 'Phi'
set key off
plot data index 0 using 1:2 with linespoints linewidth 1.5 pointtype 5 linecolor 1 title 'moduli', \
     data index 1 using 1:2 with linespoints linewidth 1.5 pointtype 6 linecolor 2 title 'together', \
     data index 2 using 1:2 with linespoints linewidth 1.5 pointtype 7 linecolor 3 title 'finish', \
     data index 3 using 1:2 with linespoints linewidth 1.5 pointtype 8 linecolor 4 title 'tolerance', \
     data index 4 using 1:2 with linespoints linewidth 1.5 pointtype 9 linecolor 5 title 'time_step', \
     data index 5 using 1:2 with linespoints linewidth 1.5 pointtype 10 linecolor 6 title 'patience', \
     data index 6 using 1:2 with linespoints linewidth 1.5 pointtype 11 linecolor 7 title 'strain_rate_cap', \
     data index 7 using 1:2 with linespoints linewidth 1.5 pointtype 12 linecolor 8 title 'cell_mass'
set title 'B'
unset ylabel
set key bottom right samplen 1.5 font ',10' noenhanced
plot data index 0 using 1:3 with linespoints linewidth 1.5 pointtype 5 linecolor 1 title 'moduli', \
     data index 1 using 1:3 with linespoints linewidth 1.5 pointtype 6 linecolor 2 title 'together', \
     data index 2 using 1:3 with linespoints linewidth 1.5 pointtype 7 linecolor 3 title 'finish', \
     data index 3 using 1:3 with linespoints linewidth 1.5 pointtype 8 linecolor 4 title 'tolerance', \
     data index 4 using 1:3 with linespoints linewidth 1.5 pointtype 9 linecolor 5 title 'time_step', \
     data index 5 using 1:3 with linespoints linewidth 1.5 pointtype 10 linecolor 6 title 'patience', \
     data index 6 using 1:3 with linespoints linewidth 1.5 pointtype 11 linecolor 7 title 'strain_rate_cap', \
     data index 7 using 1:3 with linespoints linewidth 1.5 pointtype 12 linecolor 8 title 'cell_mass'
unset multiplot
