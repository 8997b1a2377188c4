; check: exit 1
; error 20962 at 3:12
#TANGFEED [RMIN=300000]
M30
