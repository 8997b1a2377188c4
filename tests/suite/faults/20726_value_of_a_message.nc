; check: exit 1
; error 20726 at 3:13
#MSG ["%D", , 5]
M30
