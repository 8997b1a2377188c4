; run --set kontur.axis[1].plant.disturbance.amplitude=-1000 --set X.getriebe[0].position_settling_time=0: exit 1
; error K-0130 at 3:1
N10 G60 G01 X10 F6000
N20 Y5
M30
