; check --set channel.range_check_prog_soft_limits=1 --set X.kenngr.swe_neg=-5000000: exit 0
; warning 21648 at 3:5
G98 X-600
G01 F1000 X-10
M30
