; check: exit 1
; page 254575499 diagnosis 21413, wrong
; error 21413 at 5:55
G00 X0 Y0 Z0
#MACHINE DATA [AX=X AXPARAM="kenngr.swe_pos 15000000" WAIT]
N1000 M30
