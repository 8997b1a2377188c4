; check -m two_spindles --set channel.main_spindle_ax_nr=1: exit 2
; error K-0031 at --set 1:1
N10 S100 M3
N20 M30
