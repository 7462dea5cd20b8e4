# Strength of disks with rolling resistance beside that of regular polygons: gnuplot rolling.gp
if (!exists('picture')) picture = 'rolling.svg'
set encoding utf8
set terminal svg size 760,460 font 'DejaVu Sans,13' background 'white' linewidth 1.3
set output picture
set datafile separator ','
set logscale x
set xrange [8e-4:0.3]
set yrange [0.22:0.57]
set xlabel 'rolling coefficient μ_R / a of the disks'
set ylabel 'stress ratio q/p at the critical state'
set key top left reverse Left samplen 1.5
case(name) = strcol('case') eq name ? column('stress_ratio') : NaN
rolling(n) = strcol('case')[1:8] eq 'rolling-' ? real(strcol('case')[9:]) : NaN
array sides = [5, 8, 20]
do for [i = 1:3] {
  stats 'points.csv' using (case(sprintf('polygons-%d', sides[i]))) name sprintf('P%d', sides[i]) nooutput
  level = value(sprintf('P%d_mean', sides[i]))
  set arrow from graph 0, first level to graph 1, first level nohead dashtype 2 linecolor rgb '#b03030'
  set label sprintf('%d sides', sides[i]) at graph 0.985, first level + 0.009 right textcolor rgb '#b03030'
}
plot 'points.csv' using (rolling(0)):(rolling(0) > 0 ? column('stress_ratio') : NaN) with points pointtype 7 pointsize 0.8 linecolor rgb '#204080' title 'disks with rolling resistance', \
     NaN with lines dashtype 2 linecolor rgb '#b03030' title 'regular polygons'
