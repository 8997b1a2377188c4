; check: exit 1
; error 21235 at 3:18
#WCS TO MCS [X=1 X=2]
M30
