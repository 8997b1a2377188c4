; check: exit 1
; error 21459 at 4:8
; error 21459 at 5:15
P1=SIN["Peter"]
P2=STR_TO_INT[123]
M30
