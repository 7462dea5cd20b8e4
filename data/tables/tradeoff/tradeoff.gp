if (!exists('picture')) picture = 'tradeoff.svg'
data = 'tradeoff.dat'
set encoding utf8
set terminal svg size 720,1040 font 'DejaVu Sans,18' background 'white' linewidth 1.5
set output picture
set multiplot layout 2,1
set logscale xy
set format y '%.0e'
set yrange [1e-10/2:*]
set xlabel 'processor time of a sample, relative to the strict settings'
set ylabel 'relative error of a state (at least 1e-10)'
set title 'Phi' noenhanced
set key off
plot data index 0 using 1:2 with linespoints linewidth 1.5 pointtype 5 linecolor 1 title 'moduli', \
     data index 1 using 1:2 with linespoints linewidth 1.5 pointtype 6 linecolor 2 title 'together', \
     data index 2 using 1:2 with linespoints linewidth 1.5 pointtype 7 linecolor 3 title 'finish', \
     data index 3 using 1:2 with linespoints linewidth 1.5 pointtype 8 linecolor 4 title 'tolerance', \
     data index 4 using 1:2 with linespoints linewidth 1.5 pointtype 9 linecolor 5 title 'time_step', \
     data index 5 using 1:2 with linespoints linewidth 1.5 pointtype 10 linecolor 6 title 'patience', \
     data index 6 using 1:2 with linespoints linewidth 1.5 pointtype 11 linecolor 7 title 'strain_rate_cap', \
     data index 7 using 1:2 with linespoints linewidth 1.5 pointtype 12 linecolor 8 title 'cell_mass'
set title 'B' noenhanced
set key bottom left samplen 1.5 font ',14' noenhanced
plot data index 0 using 1:3 with linespoints linewidth 1.5 pointtype 5 linecolor 1 title 'moduli', \
     data index 1 using 1:3 with linespoints linewidth 1.5 pointtype 6 linecolor 2 title 'together', \
     data index 2 using 1:3 with linespoints linewidth 1.5 pointtype 7 linecolor 3 title 'finish', \
     data index 3 using 1:3 with linespoints linewidth 1.5 pointtype 8 linecolor 4 title 'tolerance', \
     data index 4 using 1:3 with linespoints linewidth 1.5 pointtype 9 linecolor 5 title 'time_step', \
     data index 5 using 1:3 with linespoints linewidth 1.5 pointtype 10 linecolor 6 title 'patience', \
     data index 6 using 1:3 with linespoints linewidth 1.5 pointtype 11 linecolor 7 title 'strain_rate_cap', \
     data index 7 using 1:3 with linespoints linewidth 1.5 pointtype 12 linecolor 8 title 'cell_mass'
unset multiplot
