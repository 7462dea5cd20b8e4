# The sweep of 4000 spheres and the base curve of 17 657 beside the published law [SVI2024]: gnuplot collapse.gp
if (!exists('picture')) picture = 'collapse.svg'
set encoding utf8
set terminal svg size 760,520 font 'DejaVu Sans,13' background 'white' linewidth 1.3
set output picture
set datafile separator ','
# What floc fit dynamic-compaction gives for the samples of sweep_4000.csv with sc <= 0.005 se: the plateau, at the
# pressure of each sample.
e_min = 0.815; De = 0.756; C = 0.234; p_D = 0.01
e_r(e, p) = (e - e_min)/(De/(1 + C*De*log(p/p_D)))
# As published.
eta_m = 0.045; s_m = 1.55; A = 0.475; a = 0.74; b = 2.3
S(x) = A*x**a + (1/s_m - A)*x**b
set logscale x
set format x '10^{%L}'
set xrange [1e-4:30]
set yrange [-0.1:1.5]
set xlabel 'η^* = sc/√(p se)'
set ylabel 'e_r = (e - e_{min})/(e_{max}(p) - e_{min})'
set key top left reverse Left samplen 1.5
plot S(x/eta_m)/(1 + S(x/eta_m)) with lines linewidth 1.5 linecolor rgb '#404040' title 'published law', \
     for [i = 1:4] 'sweep_4000.csv' using (column('p') == word('0.01 0.1 0.5 1', i) + 0 ? column('eta_star') : NaN):(e_r(column('e'), column('p'))) \
       with points pointtype 4 + 2*i pointsize 0.7 linecolor i title '4000 spheres, p = '.word('0.01 0.1 0.5 1', i), \
     'base_17657.csv' using 'eta_star':(e_r(column('e'), column('p'))) with points pointtype 7 pointsize 0.9 linecolor rgb 'black' title '17 657 spheres, p = 0.1'
