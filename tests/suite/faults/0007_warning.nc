; check: exit 0
; warning 7 at 3:1
#ERROR [ID=7 RC=0]
M30
