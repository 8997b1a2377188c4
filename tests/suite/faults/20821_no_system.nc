; check: exit 1
; error 20821 at 3:1
#CS ON
M30
