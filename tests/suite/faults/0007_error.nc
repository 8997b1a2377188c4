; check: exit 1
; error 7 at 3:1
#ERROR [ID=7 RC=2]
M30
