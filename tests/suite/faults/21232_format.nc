; check: exit 1
; error 21232 at 3:7
#MSG ["%x", 1]
M30
