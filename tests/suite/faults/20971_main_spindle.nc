; check -m two_spindles --set channel.main_spindle_name=QQ: exit 0
; warning 20971 at --set 1:1
N10 S100 M3
N20 M30
