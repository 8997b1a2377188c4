; check: exit 1
; error 20963 at 3:12
#TANGFEED [RMIN=-5]
M30
