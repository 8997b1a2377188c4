; check: exit 1
; error 22254 at 4:19
"A" = "X10"
P1 = MACRO_LENGTH[A]
M30
