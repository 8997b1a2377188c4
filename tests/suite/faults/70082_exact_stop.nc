; run --set X.getriebe[0].kv=1000 --set X.getriebe[0].window=10 --set X.getriebe[0].position_settling_time=20000: exit 1
; error 70082 at 4:1
N10 G01 X10 F6000
N20 G60 X20
N30 X30
M30
