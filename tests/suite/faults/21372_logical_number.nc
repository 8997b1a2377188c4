; check: exit 1
; error 21372 at 3:16
#DRIVE WR SYN [AXNR=77 KEY=torque VAL=1]
M30
