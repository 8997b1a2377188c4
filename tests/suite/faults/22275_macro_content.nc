; check: exit 1
; error 22275 at 4:23
"A" = "X10"
V.P.T = MACRO_CONTENT[A]
M30
