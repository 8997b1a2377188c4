; check: exit 1
; page 254758283 diagnosis 21459, wrong
; error 21459 at 5:14
; error 21459 at 6:21
N10 P1 = SIN["Peter"]
N20 P2 = STR_TO_INT[123]
N30 M30
