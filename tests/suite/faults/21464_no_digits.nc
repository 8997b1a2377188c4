; check: exit 1
; error 21464 at 3:17
P1 = STR_TO_INT["abc"]
M30
