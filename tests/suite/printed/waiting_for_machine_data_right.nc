; run: exit 0
; page 254575499 diagnosis 21413, right
G00 X0 Y0 Z0
#MACHINE DATA SYN [AX=X AXPARAM="kenngr.swe_pos 15000000" WAIT]
N1000 M30
