; check: exit 1
; error 21388 at 3:20
#OTC [WEAR_CONST=1 WEAR_CONST=2]
M30
