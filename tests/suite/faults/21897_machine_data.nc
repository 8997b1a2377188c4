; check: exit 1
; error 21897 at 6:1
G01 X200 F6000
X0
#MACHINE DATA [AX=X AXPARAM="kenngr.swe_pos 1500000"]
X200
M30
