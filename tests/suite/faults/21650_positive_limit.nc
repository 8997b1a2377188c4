; check --set channel.range_check_prog_soft_limits=1 --set X.kenngr.swe_pos=5000000: exit 0
; warning 21650 at 3:5
G99 X600
G01 F1000 X10
M30
