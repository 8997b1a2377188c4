; check: exit 1
; error 20932 at 3:9
#DELETE V.P.NOTHING
M30
